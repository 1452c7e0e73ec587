// KHR_texture_transform; `unit` is that of the texture.
vec2 movedUv(vec2 uv, int unit) {
  vec4 axes = materials[materialIndex].uvAxes[unit];
  return axes.xy * uv.x + axes.zw * uv.y + materials[materialIndex].uvOffsets[unit].xy;
}
