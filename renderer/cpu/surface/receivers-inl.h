// The points of surfaces that triangles show, without what they are made of.
#if defined(GNOMON_CPU_RECEIVERS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_CPU_RECEIVERS_INL_H
#undef GNOMON_CPU_RECEIVERS_INL_H
#else
#define GNOMON_CPU_RECEIVERS_INL_H
#endif

#include <bit>

#include "renderer/cpu/surface/fragments-inl.h"
#include "renderer/cpu/surface/vertices-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

/// Of fragments that show triangles of one instance.
HWY_INLINE Receiver instanceReceivers(const FrameScene& scene, std::uint32_t instance, const Int& triangle,
                                      const Fragments& fragments) {
  const Corners corners(scene, scene.slots[scene.geometry.firstSlot[instance]], triangle);
  const shared::InstanceData& placed = scene.instances[instance];
  const Triangle local = corners.triangle();
  const auto turned = [&](const Float3& v) HWY_ATTR {
    Float parts[3];
    for (int row = 0; row < 3; ++row) {
      const glm::vec4& r = placed.relativeFromLocal[row];
      parts[row] = dot(Float3(r.x, r.y, r.z), v);
    }
    return Float3(parts[0], parts[1], parts[2]);
  };
  const auto& rows = placed.relativeFromLocal;
  const Float3 offset(rows[0].w, rows[1].w, rows[2].w);
  const Sight sight = sightThrough(scene.frame, fragments.place);
  const Meeting meeting = meetingOf(sight, {turned(local.corner) + offset, turned(local.edge1), turned(local.edge2)});
  Receiver receiver;
  receiver.shown = fragments.shown;
  receiver.relative = sight.origin + sight.way * meeting.depth;
  receiver.viewDepth = asSurveyed(scene.frame, meeting.depth);
  receiver.groupBit = Int(1 << static_cast<int>(placed.normalFromLocal[0].w));
  receiver.place = fragments.place;
  receiver.samples = 1;
  receiver.triangle = fragments.triangle;
  receiver.weights = {meeting.u, meeting.v};
  // As surfaces have them, to the bit: what is marked for these receivers is read for those.
  const Float3 toEye = scene.frame.forward.w > 0.0f ? directionOf(-receiver.relative, -sight.way)
                                                    : Float3(-glm::vec3(scene.frame.forward));
  const Float3 face = directionOf(meeting.normal, toEye);
  receiver.normal = select(dot(face, toEye) < 0.0f, -face, face);
  return receiver;
}

HWY_INLINE void put(const Mask& where, const Receiver& from, Receiver& to) {
  to.relative = select(where, from.relative, to.relative);
  to.normal = select(where, from.normal, to.normal);
  to.viewDepth = select(where, from.viewDepth, to.viewDepth);
  to.groupBit = select(where, from.groupBit, to.groupBit);
  to.weights = select(where, from.weights, to.weights);
}

/// Lanes that show one instance are worked on together; a packet mostly shows one.
inline Receiver receiversOf(const FrameScene& scene, const Fragments& fragments) {
  static_assert(kClusterTriangles == 1 << 10);
  const Int slot = shiftRightUnsigned<10>(fragments.triangle);
  alignas(64) std::int32_t slots[kLanes];
  alignas(64) std::int32_t triangles[kLanes];
  store(slot, slots);
  store(fragments.triangle, triangles);
  Receiver receiver{};
  receiver.shown = fragments.shown;
  unsigned left = bitsOf(fragments.shown);
  for (bool first = true; left != 0; first = false) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(left));
    const std::uint32_t instance = scene.slots[static_cast<std::size_t>(slots[lane])].instance;
    const auto begin = static_cast<std::int32_t>(scene.geometry.firstSlot[instance]);
    const auto end = static_cast<std::int32_t>(scene.geometry.firstSlot[instance + 1]);
    const Mask own = fragments.shown & (slot >= Int(begin)) & (slot < Int(end));
    // What the other lanes show is no triangle of this instance.
    const Int triangle = select(own, fragments.triangle, Int(triangles[lane])) - shiftLeft<10>(Int(begin));
    const Receiver found = instanceReceivers(scene, instance, triangle, fragments);
    if (first) receiver = found;
    put(own, found, receiver);
    left &= ~bitsOf(own);
  }
  return receiver;
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
