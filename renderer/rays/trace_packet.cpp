#include "renderer/rays/trace_packet.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace gnomon {
namespace {

template <class Part>
Part partOf(const RTCRay16& rays, unsigned first) {
  Part part;
  const auto copy = [first](const auto& from, auto& to) { std::copy_n(from + first, std::size(to), to); };
  copy(rays.org_x, part.org_x);
  copy(rays.org_y, part.org_y);
  copy(rays.org_z, part.org_z);
  copy(rays.tnear, part.tnear);
  copy(rays.dir_x, part.dir_x);
  copy(rays.dir_y, part.dir_y);
  copy(rays.dir_z, part.dir_z);
  copy(rays.time, part.time);
  copy(rays.tfar, part.tfar);
  copy(rays.mask, part.mask);
  copy(rays.id, part.id);
  copy(rays.flags, part.flags);
  return part;
}

template <class Part>
void takeHits(const Part& part, unsigned first, RTCHit16& hits) {
  const auto copy = [first](const auto& from, auto& to) { std::copy_n(from, std::size(from), to + first); };
  copy(part.Ng_x, hits.Ng_x);
  copy(part.Ng_y, hits.Ng_y);
  copy(part.Ng_z, hits.Ng_z);
  copy(part.u, hits.u);
  copy(part.v, hits.v);
  copy(part.primID, hits.primID);
  copy(part.geomID, hits.geomID);
  copy(part.instID[0], hits.instID[0]);
}

/// Calls trace(active, first) for each part of so many lanes that has an active one.
template <std::size_t width, class Trace>
void forEachPart(const Lanes& lanes, const Trace& trace) {
  for (unsigned first = 0; first < kLanes; first += width) {
    const int* active = lanes.active.data() + first;
    if (std::any_of(active, active + width, [](int lane) { return lane != 0; })) trace(active, first);
  }
}

template <class RayHits>
void intersectParts(void (*trace)(const int*, RTCScene, RTCIntersectContext*, RayHits*), RTCScene scene,
                    const Lanes& lanes, RTCIntersectContext& context, RTCRayHit16& packet) {
  using Rays = decltype(RayHits::ray);
  constexpr std::size_t width = sizeof(Rays::tfar) / sizeof(float);
  forEachPart<width>(lanes, [&](const int* active, unsigned first) {
    RayHits part;
    part.ray = partOf<Rays>(packet.ray, first);
    std::copy_n(packet.hit.geomID + first, width, part.hit.geomID);
    trace(active, scene, &context, &part);
    std::copy_n(part.ray.tfar, width, packet.ray.tfar + first);
    takeHits(part.hit, first, packet.hit);
  });
}

template <class Rays>
void occludeParts(void (*trace)(const int*, RTCScene, RTCIntersectContext*, Rays*), RTCScene scene, const Lanes& lanes,
                  RTCIntersectContext& context, RTCRay16& rays) {
  constexpr std::size_t width = sizeof(Rays::tfar) / sizeof(float);
  forEachPart<width>(lanes, [&](const int* active, unsigned first) {
    Rays part = partOf<Rays>(rays, first);
    trace(active, scene, &context, &part);
    std::copy_n(part.tfar, width, rays.tfar + first);
  });
}

/// Embree asserts that rays are finite and begin no farther off than this. One that begins beyond it would meet nothing
/// that its direction, in floats, distinguishes from what lies beside it.
constexpr float kFarthest = 1.8e18f;

/// The active lanes whose rays may be traced. The others meet nothing.
Lanes traceable(const Lanes& lanes, const RTCRay16& rays) {
  Lanes sound;
  for (unsigned i = 0; i < kLanes; ++i) {
    bool isSound = rays.tfar[i] == rays.tfar[i];
    for (const float part :
         {rays.org_x[i], rays.org_y[i], rays.org_z[i], rays.dir_x[i], rays.dir_y[i], rays.dir_z[i]}) {
      isSound = isSound && std::abs(part) <= kFarthest;
    }
    sound.active[i] = isSound ? lanes.active[i] : 0;
  }
  return sound;
}

} // namespace

unsigned widestPackets(RTCDevice device) {
  if (rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED) != 0) return 16;
  return rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED) != 0 ? 8 : 4;
}

void intersect(const TracedScene::Tree& tree, const Lanes& asked, RTCIntersectContext& context, RTCRayHit16& packet) {
  const RTCScene scene = tree.rays.get();
  const Lanes lanes = traceable(asked, packet.ray);
  if (tree.packets == 16) {
    rtcIntersect16(lanes.active.data(), scene, &context, &packet);
  } else if (tree.packets == 8) {
    intersectParts(rtcIntersect8, scene, lanes, context, packet);
  } else {
    intersectParts(rtcIntersect4, scene, lanes, context, packet);
  }
}

void occlude(const TracedScene::Tree& tree, const Lanes& asked, RTCIntersectContext& context, RTCRay16& rays) {
  const RTCScene scene = tree.rays.get();
  const Lanes lanes = traceable(asked, rays);
  if (tree.packets == 16) {
    rtcOccluded16(lanes.active.data(), scene, &context, &rays);
  } else if (tree.packets == 8) {
    occludeParts(rtcOccluded8, scene, lanes, context, rays);
  } else {
    occludeParts(rtcOccluded4, scene, lanes, context, rays);
  }
}

} // namespace gnomon
