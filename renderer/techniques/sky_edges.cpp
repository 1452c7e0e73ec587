#include "renderer/techniques/sky_edges.h"

#include <algorithm>
#include <atomic>

#include "renderer/core/stop.h"
#include "renderer/techniques/picture_shares.h"

namespace gnomon {
namespace {

constexpr float kSamePlane = 0.01f; ///< squared sine of the way from one point of a surface to another
constexpr float kSameNormal = 0.9f; ///< cosine

/// A sample that shows another triangle than its pixel's first one does, and the pixels around.
struct OddSample {
  glm::ivec2 pixel;
  std::uint32_t sample;
  std::uint32_t number;
};

struct Shown {
  glm::vec3 point, normal;
};

Shown shownAt(const DrawnSurfaces& surfaces, std::size_t i) {
  return {{surfaces.relative[0][i], surfaces.relative[1][i], surfaces.relative[2][i]},
          {surfaces.normal[0][i], surfaces.normal[1][i], surfaces.normal[2][i]}};
}

bool isOneSurface(const Shown& a, const Shown& b) {
  const glm::vec3 way = b.point - a.point;
  const float along = glm::dot(way, a.normal);
  return along * along <= kSamePlane * glm::dot(way, way) && glm::dot(a.normal, b.normal) >= kSameNormal;
}

/// The mean of the pixels around that show the sample's surface; nothing where none does.
std::optional<glm::u16vec4> meanAround(const PicturePoints& points, const OddSample& odd,
                                       const UnfilledVector<glm::u16vec4>& even) {
  const SampleGrid& grid = points.grid();
  ShownSamples shown;
  shown.add(odd.pixel, odd.sample, odd.number);
  forEachAround(grid, grid.numberOf(odd.pixel), [&](std::uint32_t other) {
    const std::uint32_t number = points.numberAt(grid.pixelAt(other));
    if (number != kNoNumber) shown.add(grid.pixelAt(other), 0, number);
  });
  const DrawnSurfaces surfaces = points.surfaces(points.drawn(shown));
  const Shown own = shownAt(surfaces, 0);
  glm::uvec4 sum(0);
  unsigned count = 0;
  for (std::size_t i = 1; i < shown.count; ++i) {
    if (shown.numbers[i] != odd.number && !isOneSurface(own, shownAt(surfaces, i))) continue;
    sum += glm::uvec4(even[grid.numberOf(shown.pixels[i])]);
    ++count;
  }
  if (count == 0) return std::nullopt;
  return glm::u16vec4((sum + count / 2) / count);
}

/// Rays from samples, sixteen at a time.
class SampleRays {
 public:
  SampleRays(const PicturePoints& points, const SkyLight& sky, const TracedSky& traced, const SkyRayPlaces& places,
             std::uint32_t rays, UnfilledVector<glm::u16vec4>& values)
      : points_(points), sky_(sky), packet_(traced), places_(places), rays_(rays), values_(values) {}

  void add(const OddSample& odd) {
    waiting_.add(odd.pixel, odd.sample, odd.number);
    if (waiting_.full()) trace();
  }

  /// Then none wait any more.
  void trace() {
    if (waiting_.count == 0) return;
    packet_.start(points_.drawn(waiting_));
    SkySums sums[SkyPlaces::kCount];
    sent_ += addSky(sky_, packet_, waiting_, places_, {0, rays_}, sums);
    for (std::size_t i = 0; i < waiting_.count; ++i) {
      const SampleGrid& grid = points_.grid();
      glm::u16vec4& value = values_[grid.numberOf(waiting_.pixels[i]) * grid.samples() + waiting_.samples[i]];
      value = glm::u16vec4(65535);
      for (int c = 0; c < 3; ++c) {
        if (sums[i].open[c] > 0) value[c] = unorm16(sums[i].arriving[c] / sums[i].open[c]);
      }
      if (sums[i].openMirror > 0) value.a = unorm16(sums[i].arrivingMirror / sums[i].openMirror);
    }
    waiting_.count = 0;
  }

  std::uint64_t sent() const { return sent_; }

 private:
  const PicturePoints& points_;
  const SkyLight& sky_;
  SkyPacket packet_;
  const SkyRayPlaces& places_;
  std::uint32_t rays_;
  UnfilledVector<glm::u16vec4>& values_;
  ShownSamples waiting_;
  std::uint64_t sent_ = 0;
};

} // namespace

UnfilledVector<glm::u16vec4> sampleShares(const PicturePoints& points, const SkyLight& sky, const TracedSky& traced,
                                          std::uint32_t few, const UnfilledVector<glm::u16vec4>& even,
                                          std::uint64_t& sent) {
  const SampleGrid& grid = points.grid();
  const std::size_t samples = grid.samples();
  if (samples == 1) return even;
  UnfilledVector<glm::u16vec4> values(even.size() * samples);
  const SkyRayPlaces places(few);
  std::atomic<std::uint64_t> more = 0;
  forEachBlock(grid, [&](const Rect& block) {
    stopIfAsked();
    SampleRays alone(points, sky, traced, places, 4 * few, values);
    forEachPixel(grid, block, [&](const glm::ivec2& pixel) {
      const std::uint32_t at = grid.numberOf(pixel);
      std::fill_n(values.begin() + static_cast<std::ptrdiff_t>(at * samples), samples, even[at]);
      for (std::uint32_t i = 1; i < samples; ++i) {
        const std::uint32_t number = points.numberAt(pixel, i);
        if (number == points.numberAt(pixel)) continue;
        glm::u16vec4& value = values[at * samples + i];
        value = glm::u16vec4(65535);
        if (number == kNoNumber) continue;
        const OddSample odd{pixel, i, number};
        if (const auto mean = meanAround(points, odd, even)) {
          value = *mean;
        } else {
          alone.add(odd);
        }
      }
    });
    alone.trace();
    more += alone.sent();
  });
  sent += more;
  return values;
}

} // namespace gnomon
