#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE \
  "renderer/cpu/show/picture_view.cpp" // NOLINT: Highway's foreach_target.h includes this again
#include <bitset>
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

HWY_INLINE Float3 radianceOf(const ShowJob& job, const Fragments& fragments, const Surface& surface) {
  const auto visibility =
      [&](std::size_t light, const Receiver& receiver, const Float3& toLight, const Mask& where)
          HWY_ATTR { return shadowVisibility(job.maps, static_cast<int>(light), receiver, toLight, where); };
  const Lighting lighting{job.maps.lights, job.lightLists, job.sky};
  if (job.view != View::lightContribution) {
    return radianceToEye(job.scene, lighting, fragments, surface, visibility);
  }
  if (job.debugLight < 0) return Float3(0.0f);
  return radianceFrom(lighting, static_cast<std::uint32_t>(job.debugLight), pointOf(surface), surface.receiver,
                      andNot(surface.unlit, fragments.shown), visibility);
}

/// Where no surface is, at pixels `x`, `y`.
HWY_INLINE SeenLight seenBehindAll(const ShowJob& job, const glm::vec4& background, const Int& x, const Int& y) {
  if (!showsSurroundings(job)) return seenLight(Float3(0.0f), Float3(glm::vec3(background)), background.w);
  const shared::FrameData& frame = job.scene.frame;
  const Sight sight = sightThrough(frame, {toFloat(x) + 0.5f, toFloat(y) + 0.5f});
  return seenLight(radianceOfSurroundings(job.scene, normalize(sight.way), frame.shownRoughness), Float3(0.0f), 1.0f);
}

/// What lanes that catch shadows show.
HWY_NOINLINE SeenLight caughtLightOf(const ShowJob& job, const Fragments& fragments, const Surface& surface) {
  const auto visibility =
      [&](std::size_t light, const Receiver& receiver, const Float3& toLight, const Mask& where)
          HWY_ATTR { return shadowVisibility(job.maps, static_cast<int>(light), receiver, toLight, where); };
  const Lighting lighting{job.maps.lights, job.lightLists, job.sky};
  const Mask asked = surface.catches & fragments.shown;
  const SeenLight behind = seenBehindAll(job, job.scene.frame.background, fragments.x, fragments.y);
  return seenThroughCatcher(behind, caughtHere(job.scene, lighting, fragments, surface, asked, visibility));
}

HWY_INLINE SeenLight seenOf(const ShowJob& job, const Fragments& fragments, const Surface& surface) {
  const Float3 radiance = radianceOf(job, fragments, surface);
  const Float3 none(0.0f);
  return seenLight(select(surface.unlit, none, radiance), select(surface.unlit, radiance, none), 1.0f);
}

/// Where some lanes catch shadows.
HWY_NOINLINE SeenLight seenWithCatcher(const ShowJob& job, const Fragments& fragments, const Surface& surface) {
  const SeenLight caught = caughtLightOf(job, fragments, surface);
  Fragments others = fragments;
  others.shown = andNot(surface.catches, fragments.shown);
  if (none(others.shown)) return caught;
  const SeenLight seen = seenOf(job, others, surface);
  return seenLight(select(surface.catches, caught.radiance, seen.radiance),
                   select(surface.catches, caught.color, seen.color),
                   select(surface.catches, caught.alpha, seen.alpha));
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

HWY_INLINE ShownColor pictureColor(const ShowJob& job, const Packet& packet) {
  const Surface surface = surfaceOf(job, packet);
  const bool catches = job.view == View::color && any(surface.catches & packet.fragments.shown);
  const SeenLight seen =
      catches ? seenWithCatcher(job, packet.fragments, surface) : seenOf(job, packet.fragments, surface);
  const ShownColor shown = shownColor(job, seen, packet.fragments.x, packet.fragments.y);
  const DebugLight debug{job.maps, job.scene.frame, job.debugLight};
  if (job.view == View::texelGrid) return {texelGrid(debug, shown.color, surface.receiver), shown.alpha};
  if (job.view != View::cascades) return shown;
  const Float grey = luminance(shown.color);
  if (!hasTiles(debug)) return {Float3(grey), shown.alpha};
  const Float3 toLight =
      towardsLight(job.maps.lights[static_cast<std::size_t>(job.debugLight)], surface.receiver.relative);
  return {cascadeTint(job.maps, job.debugLight, surface.receiver, toLight) * grey, shown.alpha};
}

/// Pixels that several surfaces share. `on`: colors count as much as they cover, as the background may be seen through
/// some of them.
class WeightedPixels {
 public:
  WeightedPixels(TileColors& colors, const glm::vec4& background, bool on)
      : colors_(colors), background_(background), on_(on) {}

  /// A surface takes the place of what is behind it in `part` of a pixel, which shows that alone at first.
  void replace(std::size_t pixel, float part, const glm::vec4& shown, const glm::vec4& behind) {
    if (on_ && !begun_[pixel]) scale(pixel, behind.w);
    begun_[pixel] = on_;
    for (int c = 0; c < 4; ++c) {
      const bool weighs = on_ && c < 3;
      const float own = weighs ? shown[c] * shown.w : shown[c];
      const float instead = weighs ? behind[c] * behind.w : behind[c];
      colors_.channels[static_cast<std::size_t>(c)][pixel] += part * (own - instead);
    }
  }

  void end() {
    for (std::size_t pixel = 0; on_ && pixel < kTilePixels; ++pixel) {
      if (!begun_[pixel]) continue;
      const float covered = colors_.channels[3][pixel];
      if (covered > 0) scale(pixel, 1 / covered);
      for (int c = 0; covered <= 0 && c < 3; ++c) colors_.channels[static_cast<std::size_t>(c)][pixel] = background_[c];
    }
  }

 private:
  void scale(std::size_t pixel, float by) {
    for (std::size_t c = 0; c < 3; ++c) colors_.channels[c][pixel] *= by;
  }

  TileColors& colors_;
  const glm::vec4 background_;
  const bool on_;
  std::bitset<kTilePixels> begun_;
};

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
  const auto& ground = job.scene.scene.ground;
  const bool catches = job.view == View::color && ground && ground->catchesShadows;
  WeightedPixels weighted(colors, background, catches && background.w < 1);
  for (std::size_t i = 0; i < list.count; i += kLanes) {
    const Packet packet = packetAt(list, i, x, y, means);
    const auto [color, alpha] = pictureColor(job, packet);
    if (fillsBlock(packet, list, i)) {
      const auto first = static_cast<std::size_t>(list.pixel[i]);
      store(color.x, &colors.channels[0][first]);
      store(color.y, &colors.channels[1][first]);
      store(color.z, &colors.channels[2][first]);
      store(alpha, &colors.channels[3][first]);
      continue;
    }
    alignas(64) float shown[4][kLanes];
    store(color.x, shown[0]);
    store(color.y, shown[1]);
    store(color.z, shown[2]);
    store(alpha, shown[3]);
    for (std::size_t lane = 0; lane < std::min(kLanes, list.count - i); ++lane) {
      const auto pixel = static_cast<std::size_t>(list.pixel[i + lane]);
      const std::int32_t samples = list.samples[i + lane];
      if (samples == means.all) {
        for (std::size_t c = 0; c < 4; ++c) colors.channels[c][pixel] = shown[c][lane];
        continue;
      }
      // What several samples show takes the background's place, share by share.
      const float part = share * static_cast<float>(__builtin_popcount(static_cast<unsigned>(samples)));
      const glm::vec4 instead = behind ? glm::vec4(behind->channels[0][pixel], behind->channels[1][pixel],
                                                   behind->channels[2][pixel], behind->channels[3][pixel])
                                       : background;
      weighted.replace(pixel, part, {shown[0][lane], shown[1][lane], shown[2][lane], shown[3][lane]}, instead);
    }
  }
  weighted.end();
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
