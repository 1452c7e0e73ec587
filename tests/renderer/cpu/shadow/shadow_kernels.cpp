#include "tests/renderer/cpu/shadow/shadow_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/renderer/cpu/shadow/shadow_kernels.cpp"
#include <hwy/foreach_target.h>

#include "renderer/cpu/shadow/read_texels-inl.h"
#include "renderer/cpu/shadow/shadow_visibility-inl.h"
#include "tests/renderer/cpu/shadow/asked_points-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

void visibilities(const ShadowMaps& maps, std::span<const AskedPoint> points, float* out) {
  for (std::size_t first = 0; first < points.size(); first += kLanes) {
    const PointPacket packet = pointPacket(points, first);
    alignas(64) float lanes[kLanes];
    store(shadowVisibility(maps, 0, packet.receiver, packet.toLight, packet.receiver.shown), lanes);
    std::copy_n(lanes, packet.count, out + first);
  }
}

void marked(const ShadowMaps& maps, std::span<const AskedPoint> points, std::span<TexelMarks> marks) {
  for (std::size_t first = 0; first < points.size(); first += kLanes) {
    const PointPacket packet = pointPacket(points, first);
    markMapReads(maps, maps.lights[0], packet.receiver, packet.toLight, marks);
  }
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gnomon::cpu {

GNOMON_EXPORT_KERNEL(visibilities);
GNOMON_EXPORT_KERNEL(marked);

void visibilitiesByLanes(const ShadowMaps& maps, std::span<const AskedPoint> points, float* out) {
  GNOMON_KERNEL(visibilities)(maps, points, out);
}

void markByLanes(const ShadowMaps& maps, std::span<const AskedPoint> points, std::span<TexelMarks> marks) {
  GNOMON_KERNEL(marked)(maps, points, marks);
}

} // namespace gnomon::cpu
#endif
