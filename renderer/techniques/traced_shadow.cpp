#include "renderer/techniques/traced_shadow.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "renderer/core/parallel.h"
#include "renderer/techniques/neighbours.h"

namespace gnomon {
namespace {

/// Pixels that one core has in hand at a time: what is kept of them stays in its caches.
constexpr std::size_t kPixels = 512;

/// Shares of 255 that differ by less show no edge between them.
constexpr int kEdge = 26;

using Pixels = std::vector<std::uint32_t>;

std::uint8_t unorm8(float share) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(share, 0.0f, 1.0f) * 255.0f));
}

Pixels eachOnce(Pixels pixels) {
  std::sort(pixels.begin(), pixels.end());
  pixels.erase(std::unique(pixels.begin(), pixels.end()), pixels.end());
  return pixels;
}

/// One light's shadow over the picture while rays complete it.
class ShadowTracing {
 public:
  ShadowTracing(const PicturePoints& points, const TraceInput& rays, int light, int samples)
      : points_(points),
        rays_(rays),
        light_(light),
        samples_(samples),
        values_(grid().pixels() * places()),
        shares_(grid().pixels()),
        away_(grid().pixels()),
        exact_(grid().pixels()) {}

  void setLit(std::uint32_t pixel) {
    shares_[pixel] = 255;
    std::fill_n(valuesOf(pixel), places(), std::uint16_t{65535});
  }

  void setTurnedAway(std::uint32_t pixel) { away_[pixel] = 1; }

  /// Sends rays from the points as they were drawn.
  void traceDrawn(const Pixels& pixels) {
    forEachPiece(pixels.size(), kPixels, [&](std::size_t first, std::size_t last) {
      const auto piece = std::span(pixels).subspan(first, last - first);
      const std::vector<SurfacePoint> drawn = points_.drawn(piece);
      const std::vector<float> found = lightVisibility(rays_, light_, drawn, samples_);
      markTurnedAway(piece, drawn, found);
      for (std::size_t i = 0; i < piece.size(); ++i) {
        std::fill_n(valuesOf(piece[i]), places(), unorm16(found[i]));
        shares_[piece[i]] = unorm8(found[i]);
      }
    });
  }

  /// Sends rays from where camera rays lead. Gives the pixels that other shares came of.
  Pixels traceExactly(const Pixels& pixels) {
    std::vector<std::uint8_t> changed(pixels.size());
    forEachPiece(pixels.size(), kPixels, [&](std::size_t first, std::size_t last) {
      const auto piece = std::span(pixels).subspan(first, last - first);
      const std::vector<SurfacePoint> hits = points_.traced(piece);
      const std::vector<float> found = lightVisibility(rays_, light_, hits, samples_);
      for (std::size_t i = 0; i < piece.size(); ++i) {
        const auto own = std::span(found).subspan(i * places(), places());
        std::transform(own.begin(), own.end(), valuesOf(piece[i]), unorm16);
        const float mean = std::accumulate(own.begin(), own.end(), 0.0f) / static_cast<float>(places());
        changed[first + i] = unorm8(mean) != shares_[piece[i]] ? 1 : 0;
        shares_[piece[i]] = unorm8(mean);
        exact_[piece[i]] = 1;
      }
    });
    Pixels moved;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      if (changed[i] != 0) moved.push_back(pixels[i]);
    }
    return moved;
  }

  /// The pixels to both sides of where surfaces that are turned away end.
  Pixels whereTurnedAwayEnds() const {
    return pixelsWhere(grid(), away_, [](std::uint8_t least, std::uint8_t most) { return least != most; });
  }

  /// The pixels at edges of the shadow whose points are not exact yet.
  Pixels atEdges() const {
    Pixels pixels = pixelsWhere(grid(), shares_, [](std::uint8_t least, std::uint8_t most) {
      return static_cast<int>(most) - static_cast<int>(least) >= kEdge;
    });
    std::erase_if(pixels, [&](std::uint32_t pixel) { return exact_[pixel] != 0; });
    return pixels;
  }

  /// Those of them that lie next to one of `moved`, or to a corner.
  Pixels atEdgesBeside(const Pixels& moved) const {
    Pixels pixels;
    const int width = grid().width;
    for (const std::uint32_t pixel : moved) {
      const int x = static_cast<int>(pixel) % width;
      const int row = static_cast<int>(pixel) / width;
      for (int line = std::max(row - 1, 0); line <= std::min(row + 1, grid().height - 1); ++line) {
        for (int column = std::max(x - 1, 0); column <= std::min(x + 1, width - 1); ++column) {
          const auto other = static_cast<std::uint32_t>(line * width + column);
          const int apart = std::abs(static_cast<int>(shares_[other]) - static_cast<int>(shares_[pixel]));
          if (exact_[other] == 0 && apart >= kEdge) pixels.push_back(other);
        }
      }
    }
    return eachOnce(std::move(pixels));
  }

  std::vector<std::uint16_t> takeValues() { return std::move(values_); }

 private:
  void markTurnedAway(std::span<const std::uint32_t> pixels, std::span<const SurfacePoint> drawn,
                      std::span<const float> found) {
    Pixels dark;
    std::vector<SurfacePoint> points;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      if (found[i] != 0) continue;
      dark.push_back(pixels[i]);
      points.push_back(drawn[i]);
    }
    const std::vector<std::uint8_t> facing = facesLight(rays_, light_, points);
    for (std::size_t i = 0; i < dark.size(); ++i) away_[dark[i]] = facing[i] == 0 ? 1 : 0;
  }

  const SampleGrid& grid() const { return points_.grid(); }
  std::size_t places() const { return grid().samples(); }
  std::vector<std::uint16_t>::iterator valuesOf(std::uint32_t pixel) {
    return values_.begin() + static_cast<std::ptrdiff_t>(pixel * places());
  }

  const PicturePoints& points_;
  const TraceInput& rays_;
  int light_;
  int samples_;
  std::vector<std::uint16_t> values_;
  std::vector<std::uint8_t> shares_; ///< 0..255, one a pixel: the mean of its samples
  std::vector<std::uint8_t> away_;   ///< one a pixel; 1 = what was drawn there is turned away from the light
  std::vector<std::uint8_t> exact_;  ///< one a pixel; 1 = camera rays led to its points
};

Pixels unsureAmong(std::span<const Verdict> verdicts, std::size_t pixels) {
  Pixels unsure;
  unsure.reserve(verdicts.empty() ? pixels : 0);
  for (std::uint32_t pixel = 0; pixel < pixels; ++pixel) {
    if (verdicts.empty() || verdicts[pixel] == Verdict::unsure) unsure.push_back(pixel);
  }
  return unsure;
}

} // namespace

TracedShadow tracedShadow(const PicturePoints& points, const TraceInput& rays, int light, int samples,
                          std::span<const Verdict> verdicts) {
  ShadowTracing shadow(points, rays, light, samples);
  for (std::uint32_t pixel = 0; pixel < verdicts.size(); ++pixel) {
    if (verdicts[pixel] == Verdict::lit) shadow.setLit(pixel);
    if (verdicts[pixel] == Verdict::turnedAway) shadow.setTurnedAway(pixel);
  }
  const Pixels unsure = unsureAmong(verdicts, points.grid().pixels());
  shadow.traceDrawn(unsure);

  std::uint64_t traced = unsure.size();
  const auto traceExactly = [&](const Pixels& pixels) {
    traced += static_cast<std::uint64_t>(std::count_if(pixels.begin(), pixels.end(), [&](std::uint32_t pixel) {
      return !verdicts.empty() && verdicts[pixel] != Verdict::unsure;
    }));
    return shadow.traceExactly(pixels);
  };
  Pixels doubtful = shadow.whereTurnedAwayEnds();
  const Pixels masked = points.besideMasks();
  doubtful.insert(doubtful.end(), masked.begin(), masked.end());
  traceExactly(eachOnce(std::move(doubtful)));
  for (Pixels next = shadow.atEdges(); !next.empty();) next = shadow.atEdgesBeside(traceExactly(next));
  return {shadow.takeValues(), traced};
}

} // namespace gnomon
