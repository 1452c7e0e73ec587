#pragma once

#include <algorithm>
#include <array>
#include <embree3/rtcore.h>
#include <functional>
#include <glm/glm.hpp>
#include <limits>
#include <numeric>

#include "renderer/scene/scene.h"

namespace gnomon {

inline constexpr unsigned kLanes = 16; ///< rays that are traced together

/// What setRay leaves as it is: the same for all rays.
inline void setAllRays(RTCRay16& packet) {
  std::fill_n(packet.tnear, kLanes, 0.0f);
  std::fill_n(packet.time, kLanes, 0.0f);
  std::fill_n(packet.mask, kLanes, ~0u);
  std::iota(packet.id, packet.id + kLanes, 0u);
  std::fill_n(packet.flags, kLanes, 0u);
}

/// Sets lane `lane` of a packet; all in the units of the tree (TracedScene::Tree::scale).
inline void setRay(RTCRay16& packet, unsigned lane, const glm::vec3& origin, const glm::dvec3& direction,
                   double length) {
  packet.org_x[lane] = origin.x;
  packet.org_y[lane] = origin.y;
  packet.org_z[lane] = origin.z;
  packet.dir_x[lane] = static_cast<float>(direction.x);
  packet.dir_y[lane] = static_cast<float>(direction.y);
  packet.dir_z[lane] = static_cast<float>(direction.z);
  packet.tfar[lane] =
      length <= std::numeric_limits<float>::max() ? static_cast<float>(length) : std::numeric_limits<float>::infinity();
}

/// Which rays of a packet are traced: -1, or 0 for those that are not.
struct alignas(64) Lanes {
  std::array<int, kLanes> active{};

  bool any() const { return std::accumulate(active.begin(), active.end(), 0, std::bit_or<>()) != 0; }
};

inline Lanes firstLanes(std::size_t count) {
  Lanes lanes;
  std::fill_n(lanes.active.begin(), std::min<std::size_t>(count, kLanes), -1);
  return lanes;
}

/// The scene's instance, from Embree's two numbers of a hit: its own instance, where a tree is shared, goes before the
/// geometry.
inline std::uint32_t instanceOf(unsigned embreeInstance, unsigned geometry) {
  return embreeInstance != RTC_INVALID_GEOMETRY_ID ? embreeInstance : geometry;
}

/// Of a lane that met something.
inline PlacedTriangle metBy(const RTCHit16& hits, unsigned lane) {
  return {instanceOf(hits.instID[0][lane], hits.geomID[lane]), hits.primID[lane]};
}

/// Which lane of its packet a candidate of a filter belongs to, and what it is.
struct Candidate {
  unsigned lane = 0;
  std::uint32_t instance = 0;
  std::uint32_t triangle = 0;
  double u = 0, v = 0; ///< as Embree found them
};

/// For each candidate of a filter call: it stays where `accept` says so.
template <class Accept>
void filterCandidates(const RTCFilterFunctionNArguments& call, Accept accept) {
  for (unsigned i = 0; i < call.N; ++i) {
    if (call.valid[i] == 0) continue;
    const Candidate candidate{RTCRayN_id(call.ray, call.N, i),
                              instanceOf(RTCHitN_instID(call.hit, call.N, i, 0), RTCHitN_geomID(call.hit, call.N, i)),
                              RTCHitN_primID(call.hit, call.N, i), RTCHitN_u(call.hit, call.N, i),
                              RTCHitN_v(call.hit, call.N, i)};
    if (!accept(candidate)) call.valid[i] = 0;
  }
}

} // namespace gnomon
