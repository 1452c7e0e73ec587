// The curved surface that shading shows in place of a triangle whose vertices have normals of their own: it passes
// through them, and its normals change evenly between them. Where the triangle is turned away from a light that this
// surface faces, shadows are those of a place on it (after Hanika, "Hacking the Shadow Terminator", Ray Tracing Gems
// II, 2021, whose places on the vertices' tangent planes lie twice as high between two of them).

// By how much more of the light a surface of shading has to see than its triangle to take its place, cosines: more than
// normals lose by being kept in 16 bits an axis.
GNOMON_CONSTANT(kLeastGain, 1e-3f);

// Cosine of normals of triangle and shading from which on they belong together at all.
GNOMON_CONSTANT(kLeastLikeness, 0.5f);

// More than 0 where the surface takes the place of its triangle, if that is turned away from (part of) the light.
GNOMON_FUNCTION Real smoothGain(Real cosineOfTriangle, Real cosineOfSurface) {
  return cosineOfSurface - max(cosineOfTriangle, Real(0.0f)) - Real(kLeastGain);
}

// Of a surface that changes by p1 and p2, and whose normals by n1 and n2, along two ways: its mean curvature times a
// positive number. More than 0 where it bends outwards, as a ball does; 0 where normals do not change.
GNOMON_FUNCTION Real outwardBend(vec3 p1, vec3 p2, vec3 n1, vec3 n2) {
  return dot(n1, p1) * dot(p2, p2) - (dot(n1, p2) + dot(n2, p1)) * dot(p1, p2) + dot(n2, p2) * dot(p1, p1);
}

// How far it lies over the place u, v of its triangle, whose sides p1 and p2 begin at a corner: exact for surfaces of
// second order. Normals of unit length.
GNOMON_FUNCTION Real heightOverTriangle(Real u, Real v, vec3 p1, vec3 p2, vec3 n1, vec3 n2) {
  Real along1 = dot(n1, p1);
  Real along2 = dot(n2, p2);
  Real across = along1 + along2 - dot(n1, p2) - dot(n2, p1);
  Real first = Real(1.0f) - u - v;
  return Real(0.5f) * (first * u * along1 + first * v * along2 + u * v * across);
}
