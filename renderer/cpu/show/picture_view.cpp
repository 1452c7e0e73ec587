#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE \
  "renderer/cpu/show/picture_view.cpp" // NOLINT: Highway's foreach_target.h includes this again
#include <hwy/foreach_target.h>
#include <optional>

#include "renderer/cpu/lanes/gather-inl.h"
#include "renderer/cpu/shadow/debug_light-inl.h"
#include "renderer/cpu/shadow/shadow_visibility-inl.h"
#include "renderer/cpu/show/packet-inl.h"
#include "renderer/cpu/show/show_view.h"
#include "renderer/cpu/surface/shading-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

HWY_INLINE Float3 radianceOf(const ShowJob& job, const Packet& packet, const Surface& surface) {
  const auto visibility =
      [&](std::size_t light, const Receiver& receiver, const Float3& toLight, const Mask& where)
          HWY_ATTR { return shadowVisibility(job.maps, static_cast<int>(light), receiver, toLight, where); };
  const Lighting lighting{job.maps.lights, job.lightLists};
  if (job.view != View::lightContribution) {
    return radianceToEye(job.scene, lighting, packet.fragments, surface, visibility);
  }
  if (job.debugLight < 0) return Float3(0.0f);
  return radianceFrom(lighting, static_cast<std::uint32_t>(job.debugLight), pointOf(surface), surface.receiver,
                      andNot(surface.unlit, packet.fragments.shown), visibility);
}

struct ShownColor {
  Float3 color; ///< linear
  Float alpha;
};

/// What shows at pixels `x`, `y` of the picture.
HWY_INLINE ShownColor shownColor(const ShowJob& job, SeenLight seen, const Int& x, const Int& y) {
  if (!job.volumes.empty()) {
    const float* values = &job.volumes[0].x;
    const Int at = (y * Int(job.scene.width) + x) * Int(4);
    const Float3 radiance(gather(values, at), gather(values, at + Int(1)), gather(values, at + Int(2)));
    seen = seenBehind(seen, radiance, gather(values, at + Int(3)));
  }
  return {shownColor(seen, job.scene.frame.exposureScale, job.tone), seen.alpha};
}

/// Where no surface is, at pixels `x`, `y`.
HWY_INLINE SeenLight seenBehindAll(const ShowJob& job, const glm::vec4& background, const Int& x, const Int& y) {
  if (!showsSurroundings(job)) return seenLight(Float3(0.0f), Float3(glm::vec3(background)), background.w);
  const shared::FrameData& frame = job.scene.frame;
  const Sight sight = sightThrough(frame, {toFloat(x) + 0.5f, toFloat(y) + 0.5f});
  return seenLight(radianceOfSurroundings(job.scene, normalize(sight.way), frame.shownRoughness), Float3(0.0f), 1.0f);
}

/// Where no surface is, with what differs from pixel to pixel.
void fillBackground(const ShowJob& job, int squareX, int squareY, const glm::vec4& background, TileColors& colors) {
  for (int first = 0; first < static_cast<int>(kTilePixels); first += static_cast<int>(kLanes)) {
    const Int pixel = Int(first) + laneNumbers();
    const Int x = min(Int(squareX) + columnOf(pixel), Int(job.scene.width - 1));
    const Int y = min(Int(squareY) + rowOf(pixel), Int(job.scene.height - 1));
    const auto [color, alpha] = shownColor(job, seenBehindAll(job, background, x, y), x, y);
    const auto at = static_cast<std::size_t>(first);
    store(color.x, &colors.channels[0][at]);
    store(color.y, &colors.channels[1][at]);
    store(color.z, &colors.channels[2][at]);
    store(alpha, &colors.channels[3][at]);
  }
}

HWY_INLINE Float3 pictureColor(const ShowJob& job, const Packet& packet) {
  const Surface surface = surfaceOf(job, packet);
  const Float3 radiance = radianceOf(job, packet, surface);
  const Float3 none(0.0f);
  const SeenLight seen = seenLight(select(surface.unlit, none, radiance), select(surface.unlit, radiance, none), 1.0f);
  const Float3 shown = shownColor(job, seen, packet.fragments.x, packet.fragments.y).color;
  const DebugLight debug{job.maps, job.scene.frame, job.debugLight};
  if (job.view == View::texelGrid) return texelGrid(debug, shown, surface.receiver);
  if (job.view != View::cascades) return shown;
  const Float grey = luminance(shown);
  if (!hasTiles(debug)) return Float3(grey);
  const Float3 toLight =
      towardsLight(job.maps.lights[static_cast<std::size_t>(job.debugLight)], surface.receiver.relative);
  return cascadeTint(job.maps, job.debugLight, surface.receiver, toLight) * grey;
}

/// Whether the sixteen fragments from `first` on are those of a block's pixels, one of each.
HWY_INLINE bool fillsBlock(const Packet& packet, const FragmentList& list, std::size_t first) {
  const std::int32_t pixel = list.pixel[first];
  return packet.whole && list.count - first >= kLanes && pixel % static_cast<int>(kLanes) == 0 &&
         all(load(&list.pixel[first]) == Int(pixel) + laneNumbers());
}

void pictureSquareOn(const ShowJob& job, const FragmentList& list, int x, int y, TileColors& colors) {
  const SampleMeans means = sampleMeans(job.buffer.samples);
  const glm::vec4 background = job.view == View::lightContribution ? glm::vec4(0, 0, 0, job.scene.frame.background.w)
                                                                   : job.scene.frame.background;
  for (std::size_t c = 0; c < 4; ++c) colors.channels[c].fill(background[static_cast<int>(c)]);
  std::optional<TileColors> behind; // of each pixel
  if (!isPlainBehind(job)) {
    fillBackground(job, x, y, background, colors);
    behind = colors;
  }
  const float share = 1.0f / static_cast<float>(job.buffer.samples);
  for (std::size_t i = 0; i < list.count; i += kLanes) {
    const Packet packet = packetAt(list, i, x, y, means);
    const Float3 color = pictureColor(job, packet);
    if (fillsBlock(packet, list, i)) {
      const auto first = static_cast<std::size_t>(list.pixel[i]);
      store(color.x, &colors.channels[0][first]);
      store(color.y, &colors.channels[1][first]);
      store(color.z, &colors.channels[2][first]);
      store(Float(1.0f), &colors.channels[3][first]);
      continue;
    }
    alignas(64) float shown[3][kLanes];
    store(color.x, shown[0]);
    store(color.y, shown[1]);
    store(color.z, shown[2]);
    for (std::size_t lane = 0; lane < std::min(kLanes, list.count - i); ++lane) {
      const auto pixel = static_cast<std::size_t>(list.pixel[i + lane]);
      const std::int32_t samples = list.samples[i + lane];
      if (samples == means.all) {
        for (std::size_t c = 0; c < 3; ++c) colors.channels[c][pixel] = shown[c][lane];
        colors.channels[3][pixel] = 1.0f;
        continue;
      }
      // What several samples show takes the background's place, share by share.
      const float part = share * static_cast<float>(__builtin_popcount(static_cast<unsigned>(samples)));
      for (std::size_t c = 0; c < 4; ++c) {
        const float own = c < 3 ? shown[c][lane] : 1.0f;
        const float instead = behind ? behind->channels[c][pixel] : background[static_cast<int>(c)];
        colors.channels[c][pixel] += part * (own - instead);
      }
    }
  }
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gnomon::cpu {
namespace {
GNOMON_EXPORT_KERNEL(pictureSquareOn);
} // namespace

void pictureSquare(const ShowJob& job, const FragmentList& list, int x, int y, TileColors& colors) {
  GNOMON_KERNEL(pictureSquareOn)(job, list, x, y, colors);
}

} // namespace gnomon::cpu
#endif
