// The points of surfaces that triangles show, without what they are made of.
#if defined(GNOMON_CPU_RECEIVERS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_CPU_RECEIVERS_INL_H
#undef GNOMON_CPU_RECEIVERS_INL_H
#else
#define GNOMON_CPU_RECEIVERS_INL_H
#endif

#include "renderer/cpu/surface/fragments-inl.h"
#include "renderer/cpu/surface/smooth_place-inl.h"
#include "renderer/cpu/surface/vertices-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

/// Lanes that show something else hold anything.
inline HWY_NOINLINE Receiver instanceReceivers(const FrameScene& scene, const OfInstance& own,
                                               const Fragments& fragments) {
  const Corners corners(scene, scene.slots[scene.geometry.firstSlot[own.instance]], own.triangle);
  const shared::InstanceData& placed = scene.instances[own.instance];
  const Sight sight = sightThrough(scene.frame, fragments.place);
  const SeenTriangle seen = corners.seen(placed.relativeFromLocal, sight);
  const Meeting meeting = meetingOf(sight, seen);
  Receiver receiver;
  receiver.shown = fragments.shown;
  receiver.relative = sight.origin + sight.way * meeting.depth;
  receiver.viewDepth = asSurveyed(scene.frame, meeting.depth);
  receiver.groupBit = Int(1 << static_cast<int>(placed.receiverGroup()));
  receiver.place = fragments.place;
  receiver.samples = 1;
  receiver.triangle = fragments.triangle;
  receiver.weights = {meeting.u, meeting.v};
  // As surfaces have it, to the bit: what is marked for these receivers is read for those.
  receiver.normal = corners.face(seen, towardsEye(sight, scene.frame));
  receiver.smooth = mayStandOff(scene, receiver, own.lanes)
                        ? smoothPlace(corners, placed.normalFromLocal, seen.triangle, meeting, receiver.normal)
                        : noSmoothPlace();
  return receiver;
}

HWY_INLINE void put(const Mask& where, const Receiver& from, Receiver& to) {
  to.relative = select(where, from.relative, to.relative);
  to.normal = select(where, from.normal, to.normal);
  to.viewDepth = select(where, from.viewDepth, to.viewDepth);
  to.groupBit = select(where, from.groupBit, to.groupBit);
  to.weights = select(where, from.weights, to.weights);
  put(where, from.smooth, to.smooth);
}

/// Lanes that show one instance are worked on together; a packet mostly shows one. REQUIRES: some lane shows one.
HWY_INLINE Receiver receiversOf(const FrameScene& scene, const Fragments& fragments) {
  unsigned left = bitsOf(fragments.shown);
  OfInstance own = instanceShown(scene, fragments, left);
  Receiver receiver = instanceReceivers(scene, own, fragments);
  while ((left &= ~bitsOf(own.lanes)) != 0) {
    own = instanceShown(scene, fragments, left);
    put(own.lanes, instanceReceivers(scene, own, fragments), receiver);
  }
  return receiver;
}

/// View depths of what is shown, metres: the surfaces' own, whatever the survey's samples saw of them.
HWY_INLINE Float ownDepths(const FrameScene& scene, const Fragments& fragments) {
  const Sight sight = sightThrough(scene.frame, fragments.place);
  const Float3 forward{scene.frame.forward};
  Float depths = 0.0f;
  OfInstance own;
  for (unsigned left = bitsOf(fragments.shown); left != 0; left &= ~bitsOf(own.lanes)) {
    own = instanceShown(scene, fragments, left);
    const Corners corners(scene, scene.slots[scene.geometry.firstSlot[own.instance]], own.triangle);
    const SeenTriangle seen = corners.seen(scene.instances[own.instance].relativeFromLocal, sight);
    depths = select(own.lanes, withinCorners(seen.triangle, forward, meetingOf(sight, seen).depth), depths);
  }
  return depths;
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
