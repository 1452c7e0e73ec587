// Normals that a texture bends. `n`: of unit length; `texel`: the texture's direction, its z along n. Of any length.

// With a tangent of the vertices, of any length; `sign` is the bitangent's.
GNOMON_FUNCTION vec3 bentByTangent(vec3 n, vec3 tangent, Real sign, vec3 texel) {
  vec3 t = normalize(tangent - n * dot(n, tangent));
  vec3 b = cross(n, t) * sign;
  return t * texel.x + b * texel.y + n * texel.z;
}

// Without tangents the texture's axes are found from the steps of position and texture coordinates to the next pixels
// (Schueler, "Normal Mapping Without Precomputed Tangents", ShaderX5).
GNOMON_FUNCTION vec3 bentBySteps(vec3 n, vec3 px, vec3 py, vec2 ux, vec2 uy, vec3 texel) {
  vec3 pxPerp = cross(n, px);
  vec3 pyPerp = cross(py, n);
  vec3 t = pyPerp * ux.x + pxPerp * uy.x;
  vec3 b = pyPerp * ux.y + pxPerp * uy.y;
  Real size = dot(t, t);
  // Both axes as long as the normal however the texture is stretched, as with MikkTSpace (Mikkelsen 2008).
  t = t * inversesqrt(size);
  vec3 side = cross(n, t);
  side = select(dot(side, b) > 0.0f, -side, side);
  return select(size > 0.0f, t * texel.x + side * texel.y + n * texel.z, n * texel.z);
}
