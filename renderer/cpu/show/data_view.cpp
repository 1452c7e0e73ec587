#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE \
  "renderer/cpu/show/data_view.cpp" // NOLINT: Highway's foreach_target.h includes this file again
#include <hwy/foreach_target.h>
#include <limits>

#include "renderer/cpu/shadow/debug_light-inl.h"
#include "renderer/cpu/shadow/shadow_visibility-inl.h"
#include "renderer/cpu/shadow/sky_share-inl.h"
#include "renderer/cpu/show/packet-inl.h"
#include "renderer/cpu/show/show_view.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

HWY_INLINE DebugLight debugLightOf(const ShowJob& job) {
  return {job.maps, job.scene.frame, job.debugLight, job.casters, job.slotNodes};
}

HWY_INLINE DebugValue depthValue(const ShowJob& job, const Fragments& fragments) {
  const Float viewDepth = ownDepths(job.scene, fragments);
  const shared::FrameData& frame = job.scene.frame;
  if (!job.encoded) return number(viewDepth + frame.ahead);
  const float span = std::max(frame.farthest - frame.nearest, 1e-6f);
  return {Float3(1.0f - 0.9f * clamp((viewDepth - frame.nearest) / span, 0.0f, 1.0f)), 1.0f};
}

HWY_INLINE DebugValue shadowValue(const ShowJob& job, const Receiver& receiver) {
  if (job.sky.values != nullptr) {
    const Float4 share = skyShare(job.sky, receiver, receiver.shown);
    return number(luminance({share.x, share.y, share.z}));
  }
  if (job.debugLight < 0) return number(1.0f);
  const Float3 toLight = towardsLight(job.maps.lights[static_cast<std::size_t>(job.debugLight)], receiver.relative);
  return number(shadowVisibility(job.maps, job.debugLight, receiver, toLight, receiver.shown));
}

/// What is unlit emits its color.
HWY_INLINE DebugValue albedoValue(const Surface& surface) {
  return {select(surface.unlit, surface.emission, surface.baseColor), 1.0f};
}

HWY_INLINE DebugValue surfaceValue(const ShowJob& job, const Surface& surface) {
  if (job.view == View::albedo) return albedoValue(surface);
  return {job.encoded ? surface.normal * 0.5f + Float3(0.5f) : surface.normal, 1.0f};
}

HWY_INLINE DebugValue receiverValue(const ShowJob& job, const Receiver& receiver) {
  if (job.view == View::shadow) return shadowValue(job, receiver);
  return debugData(debugLightOf(job), job.view, job.encoded, receiver);
}

HWY_INLINE DebugValue valueOf(const ShowJob& job, const Packet& packet) {
  if (job.view == View::depth) return depthValue(job, packet.fragments);
  return traitsOf(job.view).material ? surfaceValue(job, surfaceOf(job, packet))
                                     : receiverValue(job, receiversOf(job, packet));
}

void dataSquareOn(const ShowJob& job, const FragmentList& list, int x, int y, TileColors& colors) {
  const SampleMeans means = sampleMeans(1);
  for (std::size_t i = 0; i < list.count; i += kLanes) {
    const Packet packet = packetAt(list, i, x, y, means);
    const DebugValue value = valueOf(job, packet);
    alignas(64) float shown[4][kLanes];
    store(value.color.x, shown[0]);
    store(value.color.y, shown[1]);
    store(value.color.z, shown[2]);
    store(value.alpha, shown[3]);
    for (std::size_t lane = 0; lane < std::min(kLanes, list.count - i); ++lane) {
      const auto pixel = static_cast<std::size_t>(list.pixel[i + lane]);
      for (std::size_t c = 0; c < 4; ++c) colors.channels[c][pixel] = shown[c][lane];
    }
  }
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gnomon::cpu {
namespace {

GNOMON_EXPORT_KERNEL(dataSquareOn);

/// The layer that says something even where no pixel's centre shows a surface, whose rim a ray may meet all the same.
const Layer* layerOf(const ShowJob& job) {
  if (job.view != View::shadow || job.debugLight < 0) return nullptr;
  const shared::LightData& light = job.maps.lights[static_cast<std::size_t>(job.debugLight)];
  if (light.visibilityLayer == 0 || light.layerOmitsTurnedFaces != 0) return nullptr;
  return &job.maps.layers[light.visibilityLayer - 1];
}

float backgroundOf(View view, bool encoded) {
  if (view == View::depth && !encoded) return std::numeric_limits<float>::infinity();
  if (view == View::shadow) return 1;
  return view == View::casterIds && !encoded ? -1.0f : 0.0f;
}

void fillBackground(const ShowJob& job, int x, int y, TileColors& colors) {
  for (auto& channel : colors.channels) channel.fill(backgroundOf(job.view, job.encoded));
  const Layer* layer = layerOf(job);
  if (layer == nullptr) return;
  const float strength = job.maps.lights[static_cast<std::size_t>(job.debugLight)].strength;
  for (int pixel = 0; pixel < static_cast<int>(kTilePixels); ++pixel) {
    const int column = x + columnOf(pixel);
    const int row = y + rowOf(pixel);
    if (column >= job.scene.width || row >= job.scene.height) continue;
    const auto at =
        static_cast<std::size_t>(row) * static_cast<std::size_t>(layer->width) + static_cast<std::size_t>(column);
    const float share = static_cast<float>(layer->values[at * static_cast<std::size_t>(layer->samples)]) / 65535.0f;
    for (auto& channel : colors.channels) channel[static_cast<std::size_t>(pixel)] = 1.0f - strength * (1.0f - share);
  }
}

} // namespace

void dataSquare(const ShowJob& job, const FragmentList& list, int x, int y, TileColors& colors) {
  fillBackground(job, x, y, colors);
  GNOMON_KERNEL(dataSquareOn)(job, list, x, y, colors);
}

} // namespace gnomon::cpu
#endif
