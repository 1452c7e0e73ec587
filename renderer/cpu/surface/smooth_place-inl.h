// The curved surface that shading shows in place of triangles (renderer/shaders/shared/smooth_surface.h).
#if defined(GNOMON_CPU_SMOOTH_PLACE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_CPU_SMOOTH_PLACE_INL_H
#undef GNOMON_CPU_SMOOTH_PLACE_INL_H
#else
#define GNOMON_CPU_SMOOTH_PLACE_INL_H
#endif

#include "renderer/cpu/lanes/shared_functions-inl.h"
#include "renderer/cpu/surface/fragments-inl.h"
#include "renderer/cpu/surface/vertices-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

HWY_INLINE void put(const Mask& where, const SmoothPlace& from, SmoothPlace& to) {
  to.bends = (where & from.bends) | andNot(where, to.bends);
  to.normal = select(where, from.normal, to.normal);
  to.height = select(where, from.height, to.height);
}

/// False only where no light asks for the smooth places of these lanes: none of their triangles is turned away from one
/// that does, nor from a part of it.
HWY_INLINE bool mayStandOff(const FrameScene& scene, const Receiver& receiver, const Mask& lanes) {
  const SmoothAsked& smooth = scene.smooth;
  if (!smooth.asked || smooth.suns.empty()) return smooth.asked;
  for (const glm::vec4& sun : smooth.suns) {
    if (any(lanes & (dot(receiver.normal, Float3(glm::vec3(sun))) <= sun.w))) return true;
  }
  return false;
}

/// `triangle`: relative to the eye; `face`: its normal, on the eye's side.
inline HWY_NOINLINE SmoothPlace smoothPlace(const Corners& corners, const glm::vec4 (&normalRows)[3],
                                            const Triangle& triangle, const Meeting& meeting, const Float3& face) {
  SmoothPlace place = noSmoothPlace();
  Float3 normals[3];
  if (!corners.normals(normalRows, normals)) return place;
  const Float3 n1 = normals[1] - normals[0], n2 = normals[2] - normals[0];
  const Float3 between = directionOf(normals[0] + n1 * meeting.u + n2 * meeting.v, face);
  const Mask inwards = dot(between, face) < 0.0f;
  const Float side = select(inwards, Float(-1.0f), 1.0f);
  place.normal = between * side;
  place.bends =
      (dot(place.normal, face) > kLeastLikeness) & (side * outwardBend(triangle.edge1, triangle.edge2, n1, n2) > 0.0f);
  const Float height = heightOverTriangle(meeting.u, meeting.v, triangle.edge1, triangle.edge2, n1, n2);
  place.height = max(side * height, 0.0f);
  return place;
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
