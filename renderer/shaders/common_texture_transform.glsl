// KHR_texture_transform; `unit` is that of the texture. Derivatives are taken of a vertex's own coordinates, and then
// turned: where a quad holds pixels that the triangle does not cover, those may read no transform.
vec2 movedStep(vec2 step, int unit) {
  vec4 axes = materials[materialIndex].uvAxes[unit];
  return axes.xy * step.x + axes.zw * step.y;
}

vec2 movedPlace(vec2 uv, int unit) { return movedStep(uv, unit) + materials[materialIndex].uvOffsets[unit].xy; }

vec4 movedTexel(sampler2D map, vec2 uv, int unit) {
  return textureGrad(map, movedPlace(uv, unit), movedStep(dFdx(uv), unit), movedStep(dFdy(uv), unit));
}
