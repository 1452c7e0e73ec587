#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE \
  "renderer/cpu/shadow/probe.cpp" // NOLINT: Highway's foreach_target.h includes this file again
#include "renderer/cpu/shadow/probe.h"

#include <algorithm>
#include <hwy/foreach_target.h>

#include "renderer/core/parallel.h"
#include "renderer/cpu/shadow/debug_light-inl.h"
#include "renderer/cpu/shadow/read_texels-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

/// The middle of the pixel of the picture that shows a point.
inline glm::vec2 shadedPixel(const shared::FrameData& frame, const glm::vec3& relative) {
  const glm::vec4 clip = frame.clipFromRelative * glm::vec4(relative, 1.0f);
  return glm::floor((glm::vec2(clip) / clip.w + 1.0f) / frame.pixelStep) + 0.5f;
}

inline Receiver receiverOf(const shared::FrameData& frame, std::span<const ProbePoint> points) {
  alignas(64) float columns[9][kLanes] = {};
  alignas(64) std::int32_t groups[kLanes] = {};
  for (std::size_t lane = 0; lane < points.size(); ++lane) {
    const ProbePoint& point = points[lane];
    const glm::vec3 relative(point.relative);
    const glm::vec2 pixel = shadedPixel(frame, relative);
    for (int axis = 0; axis < 3; ++axis) {
      columns[axis][lane] = relative[axis];
      columns[3 + axis][lane] = static_cast<float>(point.normal[axis]);
    }
    columns[6][lane] = static_cast<float>(glm::dot(point.relative, glm::dvec3(frame.forward)));
    columns[7][lane] = pixel.x;
    columns[8][lane] = pixel.y;
    groups[lane] = static_cast<std::int32_t>(1u << point.group);
  }
  Receiver receiver;
  receiver.shown = firstLanes(points.size());
  receiver.relative = {load(columns[0]), load(columns[1]), load(columns[2])};
  receiver.normal = {load(columns[3]), load(columns[4]), load(columns[5])};
  receiver.viewDepth = load(columns[6]);
  receiver.groupBit = load(groups);
  receiver.place = {load(columns[7]), load(columns[8])};
  receiver.samples = 1;
  receiver.triangle = -1;
  receiver.weights = Float2(Float(0.0f));
  receiver.smooth = noSmoothPlace();
  return receiver;
}

void probeShares(const ShadowMaps& maps, const shared::FrameData& frame, int light, std::span<const ProbePoint> points,
                 float* out) {
  const LightData& data = maps.lights[light];
  for (std::size_t first = 0; first < points.size(); first += kLanes) {
    const std::size_t count = std::min(kLanes, points.size() - first);
    const Receiver receiver = receiverOf(frame, points.subspan(first, count));
    alignas(64) float shares[kLanes];
    store(mapVisibility(maps, data, receiver, towardsLight(data, receiver.relative), receiver.shown), shares);
    std::copy_n(shares, count, out + first);
  }
}

void markPoints(const ShadowMaps& maps, const shared::FrameData& frame, int light, std::span<const ProbePoint> points,
                std::span<TexelMarks> marks) {
  const LightData& data = maps.lights[light];
  for (std::size_t first = 0; first < points.size(); first += kLanes) {
    const std::size_t count = std::min(kLanes, points.size() - first);
    const Receiver receiver = receiverOf(frame, points.subspan(first, count));
    markMapReads(maps, data, receiver, towardsLight(data, receiver.relative), marks);
  }
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gnomon::cpu {
namespace {

GNOMON_EXPORT_KERNEL(probeShares);
GNOMON_EXPORT_KERNEL(markPoints);

constexpr std::size_t kPointsAPiece = 1024;

} // namespace

std::vector<float> probedShares(const ShadowMaps& maps, const shared::FrameData& frame, int light,
                                std::span<const ProbePoint> points) {
  std::vector<float> shares(points.size());
  forEachPiece(points.size(), kPointsAPiece, [&](std::size_t first, std::size_t last) {
    GNOMON_KERNEL(probeShares)(maps, frame, light, points.subspan(first, last - first), shares.data() + first);
  });
  return shares;
}

void markProbed(const ShadowMaps& maps, const shared::FrameData& frame, int light, std::span<const ProbePoint> points,
                std::span<TexelMarks> marks) {
  forEachPiece(points.size(), kPointsAPiece, [&](std::size_t first, std::size_t last) {
    GNOMON_KERNEL(markPoints)(maps, frame, light, points.subspan(first, last - first), marks);
  });
}

} // namespace gnomon::cpu
#endif
