#include "tests/renderer/cpu/shadow/debug_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/renderer/cpu/shadow/debug_kernels.cpp"
#include <hwy/foreach_target.h>

#include "renderer/cpu/shadow/caster_ids-inl.h"
#include "renderer/cpu/shadow/map_footprints-inl.h"
#include "renderer/cpu/surface/receivers-inl.h"
#include "tests/renderer/cpu/shadow/asked_points-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

inline DebugLight debugLight(const DebugMaps& debug) {
  return {debug.maps, debug.frame, 0, debug.casters, debug.slotNodes};
}

void debugValues(const DebugMaps& debug, View view, bool encoded, std::span<const AskedPoint> points, glm::vec4* out) {
  for (std::size_t first = 0; first < points.size(); first += kLanes) {
    const PointPacket packet = pointPacket(points, first);
    const DebugValue value = debugData(debugLight(debug), view, encoded, packet.receiver);
    glm::vec3 colors[kLanes];
    alignas(64) float alphas[kLanes];
    storePoints(value.color, colors, packet.count);
    store(value.alpha, alphas);
    for (std::size_t i = 0; i < packet.count; ++i) out[first + i] = glm::vec4(colors[i], alphas[i]);
  }
}

void grids(const DebugMaps& debug, const glm::vec3& shown, std::span<const AskedPoint> points, glm::vec3* out) {
  for (std::size_t first = 0; first < points.size(); first += kLanes) {
    const PointPacket packet = pointPacket(points, first);
    storePoints(texelGrid(debugLight(debug), Float3(shown), packet.receiver), out + first, packet.count);
  }
}

void footprints(const DebugMaps& debug, std::span<const AskedPoint> points, MapFootprint* out) {
  for (std::size_t first = 0; first < points.size(); first += kLanes) {
    const PointPacket packet = pointPacket(points, first);
    storeFootprints(footprintsOf(debugLight(debug), packet.receiver), packet.receiver, packet.count, out + first);
  }
}

void receivers(const FrameScene& scene, const ShownPlaces& shown, AskedPoint* out) {
  for (std::size_t first = 0; first < shown.triangles.size(); first += kLanes) {
    const std::size_t count = std::min(kLanes, shown.triangles.size() - first);
    alignas(64) std::uint32_t triangles[kLanes];
    alignas(64) float x[kLanes] = {}, y[kLanes] = {};
    std::fill_n(triangles, kLanes, kNoNumber);
    for (std::size_t i = 0; i < count; ++i) {
      triangles[i] = shown.triangles[first + i];
      x[i] = shown.places[first + i].x;
      y[i] = shown.places[first + i].y;
    }
    Fragments fragments;
    fragments.triangle = load(triangles);
    fragments.shown = fragments.triangle != Int(static_cast<std::int32_t>(kNoNumber));
    fragments.place = {load(x), load(y)};
    if (none(fragments.shown)) continue;
    const Receiver receiver = receiversOf(scene, fragments);
    glm::vec3 relative[kLanes], normal[kLanes];
    alignas(64) float depth[kLanes];
    alignas(64) std::uint32_t group[kLanes];
    storePoints(receiver.relative, relative, kLanes);
    storePoints(receiver.normal, normal, kLanes);
    store(receiver.viewDepth, depth);
    store(receiver.groupBit, group);
    for (std::size_t i = 0; i < count; ++i) {
      if (triangles[i] == kNoNumber) continue;
      AskedPoint& point = out[first + i];
      point.relative = relative[i];
      point.normal = normal[i];
      point.viewDepth = depth[i];
      point.groupBit = group[i];
      point.place = {x[i], y[i]};
    }
  }
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gnomon::cpu {

GNOMON_EXPORT_KERNEL(debugValues);
GNOMON_EXPORT_KERNEL(grids);
GNOMON_EXPORT_KERNEL(footprints);
GNOMON_EXPORT_KERNEL(receivers);

void debugDataByLanes(const DebugMaps& debug, View view, bool encoded, std::span<const AskedPoint> points,
                      glm::vec4* out) {
  GNOMON_KERNEL(debugValues)(debug, view, encoded, points, out);
}

void texelGridByLanes(const DebugMaps& debug, const glm::vec3& shown, std::span<const AskedPoint> points,
                      glm::vec3* out) {
  GNOMON_KERNEL(grids)(debug, shown, points, out);
}

void footprintsByLanes(const DebugMaps& debug, std::span<const AskedPoint> points, MapFootprint* out) {
  GNOMON_KERNEL(footprints)(debug, points, out);
}

void receiversByLanes(const FrameScene& scene, const ShownPlaces& shown, AskedPoint* out) {
  GNOMON_KERNEL(receivers)(scene, shown, out);
}

} // namespace gnomon::cpu
#endif
