// Directions as two numbers from -1 to 1 (Cigolle et al., "A Survey of Efficient Representations for Independent Unit
// Vectors", JCGT 2014); as 16 bits each they are within 7e-5 radians.

// `n`: of any length but 0.
GNOMON_FUNCTION vec2 octahedral(vec3 n) {
  vec2 p = vec2(n.x, n.y) / (abs(n.x) + abs(n.y) + abs(n.z));
  vec2 folded = vec2((1.0f - abs(p.y)) * select(p.x >= 0.0f, Real(1.0f), Real(-1.0f)),
                     (1.0f - abs(p.x)) * select(p.y >= 0.0f, Real(1.0f), Real(-1.0f)));
  return select(n.z >= 0.0f, p, folded);
}

GNOMON_FUNCTION vec3 fromOctahedral(vec2 p) {
  Real z = 1.0f - abs(p.x) - abs(p.y);
  Real fold = max(-z, 0.0f);
  return normalize(vec3(p.x + select(p.x >= 0.0f, -fold, fold), p.y + select(p.y >= 0.0f, -fold, fold), z));
}
