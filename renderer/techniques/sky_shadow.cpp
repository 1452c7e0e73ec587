#include "renderer/techniques/sky_shadow.h"

#include <algorithm>
#include <atomic>

#include "renderer/core/stop.h"
#include "renderer/techniques/picture_shares.h"
#include "renderer/techniques/sky_edges.h"
#include "renderer/techniques/sky_shares.h"

namespace gnomon {
namespace {

float brightness(const glm::vec3& color) {
  return glm::dot(color, glm::vec3(0.2126f, 0.7152f, 0.0722f));
}

/// The mean of two shares, as they weigh.
std::uint16_t mixed(std::uint16_t known, float before, float sum, float weight) {
  const float share = before > 0 ? static_cast<float>(known) / 65535.0f : 0.0f;
  return unorm16((share * before + sum) / (before + weight));
}

void addTo(SkyShares& shares, std::uint32_t pixel, const SkySums& sums) {
  glm::u16vec4& own = shares.shares[pixel];
  if (const float weight = brightness(sums.open); weight > 0) {
    const float before = shares.weights[pixel];
    for (int i = 0; i < 3; ++i) {
      // A color that nothing is lit by has the share of all others.
      const bool any = sums.open[i] > 0;
      const float ratio = any ? sums.arriving[i] / sums.open[i] : brightness(sums.arriving) / weight;
      own[i] = mixed(own[i], before, ratio * weight, weight);
    }
    shares.weights[pixel] = before + weight;
  }
  if (sums.openMirror > 0) {
    own.a = mixed(own.a, shares.mirrors[pixel], sums.arrivingMirror, sums.openMirror);
    shares.mirrors[pixel] += sums.openMirror;
  }
}

/// A picture's rays to an environment.
class SkyTracing {
 public:
  SkyTracing(const PicturePoints& points, const SkyLight& sky, std::uint32_t few)
      : points_(points), sky_(sky), traced_(points.rays()), places_(few), shares_(points.grid()) {}

  /// Rays `round` of each pixel that `asked` holds for; of all where it is empty.
  void trace(const SkyRays& round, std::span<const std::uint8_t> asked) {
    forEachBlock(points_.grid(), [&](const Rect& block) {
      stopIfAsked();
      SkyPacket packet(traced_);
      ShownSamples waiting;
      forEachPixel(points_.grid(), block, [&](const glm::ivec2& pixel) {
        const std::uint32_t at = points_.grid().numberOf(pixel);
        if (asked.empty()) shares_.clear(at);
        const std::uint32_t number = points_.numberAt(pixel);
        if (number == kNoNumber || (!asked.empty() && asked[at] == 0)) return;
        waiting.add(pixel, 0, number);
        if (waiting.full()) trace(round, packet, waiting);
      });
      if (waiting.count > 0) trace(round, packet, waiting);
    });
  }

  SkyShares& shares() { return shares_; }
  const TracedSky& traced() const { return traced_; }
  std::uint64_t sent() const { return sent_; }

 private:
  void trace(const SkyRays& round, SkyPacket& packet, ShownSamples& waiting) {
    packet.start(points_.drawn(waiting));
    SkySums sums[SkyPlaces::kCount];
    sent_ += addSky(sky_, packet, waiting, places_, round, sums);
    for (std::size_t i = 0; i < waiting.count; ++i) {
      if (packet.places().receives[i] == 0) continue;
      const std::uint32_t pixel = points_.grid().numberOf(waiting.pixels[i]);
      addTo(shares_, pixel, sums[i]);
      shares_.rays[pixel] = static_cast<std::uint16_t>(round.last);
    }
    waiting.count = 0;
  }

  const PicturePoints& points_;
  const SkyLight& sky_;
  TracedSky traced_;
  SkyRayPlaces places_;
  SkyShares shares_;
  std::atomic<std::uint64_t> sent_ = 0;
};

} // namespace

SkyShadow skyShadow(const PicturePoints& points, const SkyLight& sky, int samples) {
  const auto few = static_cast<std::uint32_t>(std::max(samples, 1));
  SkyTracing tracing(points, sky, few);
  tracing.trace({0, few}, {});
  tracing.trace({few, 4 * few}, uneven(points, tracing.shares()));
  const UnfilledVector<glm::u16vec4> even = evenedOut(points, tracing.shares());
  SkyShadow shadow;
  shadow.tracedPixels = static_cast<std::uint64_t>(std::count_if(
      tracing.shares().rays.begin(), tracing.shares().rays.end(), [](std::uint16_t rays) { return rays > 0; }));
  shadow.rays = tracing.sent();
  shadow.values = sampleShares(points, sky, tracing.traced(), few, even, shadow.rays);
  return shadow;
}

} // namespace gnomon
