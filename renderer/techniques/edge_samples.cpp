#include <numeric>

#include "renderer/core/stop.h"
#include "renderer/techniques/picture_shares.h"

namespace gnomon {
namespace {

constexpr std::size_t kPixels = 512; ///< that one core has in hand at a time: what is kept of them stays in its caches

/// The pixels square by square of the picture: a packet of rays from pixels side by side meets the same nodes of a
/// tree, one from a row of the picture does not.
Pixels inSquares(const SampleGrid& grid, const Pixels& pixels) {
  constexpr auto kSide = 16u; // pixels
  const auto width = static_cast<std::uint32_t>(grid.width);
  const std::uint32_t columns = (width + kSide - 1) / kSide;
  const std::uint32_t rows = (static_cast<std::uint32_t>(grid.height) + kSide - 1) / kSide;
  std::vector<std::uint32_t> squares(pixels.size());
  std::vector<std::uint32_t> next(columns * rows + 1);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    squares[i] = pixels[i] / width / kSide * columns + pixels[i] % width / kSide;
    ++next[squares[i] + 1];
  }
  std::partial_sum(next.begin(), next.end(), next.begin());
  Pixels ordered(pixels.size());
  for (std::size_t i = 0; i < pixels.size(); ++i) ordered[next[squares[i]]++] = pixels[i];
  return ordered;
}

/// Calls `trace(piece)` for pieces of the pixels, in parallel, which sets the values of their samples. Then no more is
/// asked of these pixels. Gives those that other shares came of.
template <class Trace>
Pixels traceEach(const Pixels& asked, PictureShares& shares, const Trace& trace) {
  const Pixels pixels = inSquares(shares.grid, asked);
  std::vector<std::uint8_t> changed(pixels.size());
  forEachPiece(pixels.size(), kPixels, [&](std::size_t first, std::size_t last) {
    const auto piece = std::span(pixels).subspan(first, last - first);
    trace(piece);
    for (std::size_t i = 0; i < piece.size(); ++i) {
      const std::uint16_t* own = shares.valuesOf(piece[i]);
      const std::uint32_t sum = std::accumulate(own, own + shares.places, 0u);
      const std::uint8_t mean = unorm8(static_cast<float>(sum) / (65535.0f * static_cast<float>(shares.places)));
      changed[first + i] = mean != shares.shares[piece[i]] ? 1 : 0;
      shares.shares[piece[i]] = mean;
      shares.marks[piece[i]] |= PictureShares::kExact;
    }
  });
  Pixels moved;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    if (changed[i] != 0) moved.push_back(pixels[i]);
  }
  return moved;
}

/// Up to DrawnPlaces::kCount pixels at one of their samples.
struct SampleOfPixels {
  std::span<const std::uint32_t> pixels;
  std::size_t first; ///< of the pixels, in what they are part of
  std::uint32_t sample;
};

/// Calls `each` for all samples of the pixels.
template <class Each>
void forEachSample(std::span<const std::uint32_t> pixels, std::size_t samples, const Each& each) {
  for (std::uint32_t sample = 0; sample < samples; ++sample) {
    for (std::size_t first = 0; first < pixels.size(); first += DrawnPlaces::kCount) {
      const std::size_t count = std::min(DrawnPlaces::kCount, pixels.size() - first);
      each(SampleOfPixels{pixels.subspan(first, count), first, sample});
    }
  }
}

DrawnPlaces drawnAt(const PicturePoints& points, const SampleOfPixels& at) {
  ShownSamples shown;
  for (const std::uint32_t number : at.pixels) {
    const glm::ivec2 pixel = points.grid().pixelAt(number);
    shown.add(pixel, at.sample, points.numberAt(pixel, at.sample));
  }
  return points.drawn(shown);
}

/// What the light's shares are where `which` holds.
template <class Which>
void traceDrawn(const TracedLight& light, const DrawnPlaces& places, const SampleOfPixels& at, int rays,
                PictureShares& shares, const Which& which) {
  float found[DrawnPlaces::kCount];
  std::uint8_t away[DrawnPlaces::kCount];
  stopIfAsked();
  const auto count = static_cast<std::uint32_t>(rays);
  light.visibility(places, at.sample * count, (at.sample + 1) * count, found, away);
  for (std::size_t i = 0; i < at.pixels.size(); ++i) {
    if (which(i)) shares.valuesOf(at.pixels[i])[at.sample] = unorm16(found[i]);
  }
}

/// Points that camera rays led to where something else was drawn, and where their shares go.
struct OtherPoints {
  std::vector<SurfacePoint> points;
  std::vector<std::uint16_t*> values;

  void trace(const TracedLight& light, int rays) const {
    std::vector<float> found(points.size());
    light.visibility(points, rays, found);
    for (std::size_t i = 0; i < found.size(); ++i) *values[i] = unorm16(found[i]);
  }
};

} // namespace

Pixels traceExactly(const PicturePoints& points, const TracedLight& light, const Pixels& pixels,
                    PictureShares& shares) {
  return traceEach(pixels, shares, [&](std::span<const std::uint32_t> piece) {
    const std::vector<SurfacePoint> hits = points.traced(piece);
    std::vector<float> found(hits.size());
    light.visibility(hits, 1, found);
    for (std::size_t i = 0; i < piece.size(); ++i) {
      const auto own = std::span(found).subspan(i * shares.places, shares.places);
      std::transform(own.begin(), own.end(), shares.valuesOf(piece[i]), unorm16);
    }
  });
}

Pixels traceDoubtful(const PicturePoints& points, const TracedLight& light, int rays, const Pixels& pixels,
                     PictureShares& shares) {
  return traceEach(pixels, shares, [&](std::span<const std::uint32_t> piece) {
    const std::vector<SurfacePoint> hits = points.traced(piece);
    OtherPoints others;
    forEachSample(piece, shares.places, [&](const SampleOfPixels& at) {
      DrawnPlaces places = drawnAt(points, at);
      bool isDrawn[DrawnPlaces::kCount] = {};
      for (std::size_t i = 0; i < at.pixels.size(); ++i) {
        const SurfacePoint& hit = hits[(at.first + i) * shares.places + at.sample];
        isDrawn[i] = hit.instance == places.shown[i].instance &&
                     (hit.instance == kNoSurface || hit.triangle == places.shown[i].triangle);
        if (isDrawn[i]) continue;
        others.points.push_back(hit);
        others.values.push_back(shares.valuesOf(at.pixels[i]) + at.sample);
        places.shown[i] = {};
      }
      // Of a pixel that has one sample, rays from the point as it was drawn have given the share.
      if (shares.places == 1) return;
      traceDrawn(light, places, at, rays, shares, [&](std::size_t i) { return isDrawn[i]; });
    });
    others.trace(light, rays);
  });
}

Pixels traceSamples(const PicturePoints& points, const TracedLight& light, int rays, const Pixels& pixels,
                    PictureShares& shares) {
  return traceEach(pixels, shares, [&](std::span<const std::uint32_t> piece) {
    forEachSample(piece, shares.places, [&](const SampleOfPixels& at) {
      traceDrawn(light, drawnAt(points, at), at, rays, shares, [](std::size_t) { return true; });
    });
  });
}

} // namespace gnomon
