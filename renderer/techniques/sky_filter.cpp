#include <algorithm>
#include <functional>

#include "renderer/core/parallel.h"
#include "renderer/core/stop.h"
#include "renderer/techniques/picture_shares.h"
#include "renderer/techniques/same_surface.h"
#include "renderer/techniques/share_square.h"
#include "renderer/techniques/sky_shares.h"
#include "renderer/techniques/sky_square.h"

namespace gnomon {
namespace {

constexpr int kSkySide = SkySquare::kSide;
constexpr int kSkyReach = SkySquare::kReach;

/// The square whose lower left pixel this is, as far as the picture goes.
struct SquarePlaceOf {
  glm::ivec2 corner;
  Rect inner, all;

  std::size_t at(const glm::ivec2& pixel) const {
    return static_cast<std::size_t>((pixel.y - corner.y + kSkyReach) * SkySquare::kWidth + pixel.x - corner.x +
                                    kSkyReach);
  }
};

SquarePlaceOf squareNumber(const SampleGrid& grid, int number) {
  const int columns = (grid.width + kSkySide - 1) / kSkySide;
  const glm::ivec2 corner(number % columns * kSkySide, number / columns * kSkySide);
  const auto within = [&](int around) {
    const glm::ivec2 low = glm::max(corner - around, glm::ivec2(0));
    const glm::ivec2 high = glm::min(corner + kSkySide + around, glm::ivec2(grid.width, grid.height));
    return Rect{low.x, low.y, high.x - low.x, high.y - low.y};
  };
  return {corner, within(0), within(kSkyReach)};
}

std::size_t squareCount(const SampleGrid& grid) {
  const auto across = [](int pixels) { return static_cast<std::size_t>((pixels + kSkySide - 1) / kSkySide); };
  return across(grid.width) * across(grid.height);
}

/// Whether any pixel has more to tell than that all arrives.
bool anyShadow(const SkyShares& shares, const Rect& of) {
  for (int y = of.y; y < of.y + of.height; ++y) {
    for (int x = of.x; x < of.x + of.width; ++x) {
      const std::uint32_t pixel = shares.grid.numberOf({x, y});
      if (shares.rays[pixel] != 0 && shares.shares[pixel] != glm::u16vec4(65535)) return true;
    }
  }
  return false;
}

void setSurfacesIn(const PicturePoints& points, const SquarePlaceOf& place, SkySquare& square) {
  ShownSamples waiting;
  const auto put = [&] {
    const DrawnSurfaces surfaces = points.surfaces(points.drawn(waiting));
    for (std::size_t i = 0; i < waiting.count; ++i) {
      const std::size_t at = place.at(waiting.pixels[i]);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        square.point[axis][at] = surfaces.relative[axis][i];
        square.normal[axis][at] = surfaces.normal[axis][i];
      }
    }
    waiting.count = 0;
  };
  forEachPixel(points.grid(), place.all, [&](const glm::ivec2& pixel) {
    if (square.shows[place.at(pixel)] == 0) return;
    waiting.add(pixel, 0, points.numberAt(pixel));
    if (waiting.full()) put();
  });
  if (waiting.count > 0) put();
}

/// Of neighbours, and of any pixel beside the one in the middle.
constexpr SurfaceLimits kStep{.flat = 0.0025f, .leastCosine = -2};
constexpr SurfaceLimits kTurnsLittle{.flat = 2, .leastCosine = 0.985f};

/// Whether each pixel shows what the next to the right and the next above show, and normals turn little: then any two
/// show the same surface as sky_sums.h asks.
bool showsOne(const SkySquare& square, const SquarePlaceOf& place) {
  const glm::ivec2 low(place.all.x, place.all.y);
  const glm::ivec2 high = low + glm::ivec2(place.all.width, place.all.height);
  const std::size_t middle = place.at((low + high) / 2);
  int all = -1;
  for (int y = low.y; all != 0 && y < high.y; ++y) {
    const std::size_t first = place.at({low.x, y});
    const std::size_t last = first + static_cast<std::size_t>(place.all.width);
    for (std::size_t i = first; i < last; ++i) all &= showsSame(square, i, middle, kTurnsLittle);
    for (std::size_t i = first; i + 1 < last; ++i) all &= showsSame(square, i + 1, i, kStep);
    if (y + 1 == high.y) break;
    for (std::size_t i = first; i < last; ++i) all &= showsSame(square, i + SkySquare::kWidth, i, kStep);
  }
  return all != 0;
}

SkySquare skySquare(const PicturePoints& points, const SkyShares& shares, const SquarePlaceOf& place) {
  SkySquare square;
  for (auto& share : square.share) std::fill_n(share, SkySquare::kCount, 1.0f);
  std::fill_n(square.weight, SkySquare::kCount, 0.0f);
  std::fill_n(square.mirror, SkySquare::kCount, 0.0f);
  std::fill_n(square.noise, SkySquare::kCount, 0.0f);
  std::fill_n(square.shows, SkySquare::kCount, 0);
  for (std::size_t axis = 0; axis < 3; ++axis) { // as if all showed one point
    std::fill_n(square.point[axis], SkySquare::kCount, 0.0f);
    std::fill_n(square.normal[axis], SkySquare::kCount, axis == 0 ? 1.0f : 0.0f);
  }
  int rays = 0;
  float noise = 0;
  for (int y = place.all.y; y < place.all.y + place.all.height; ++y) {
    for (int x = place.all.x; x < place.all.x + place.all.width; ++x) {
      const std::uint32_t pixel = shares.grid.numberOf({x, y});
      if (shares.rays[pixel] == 0) continue;
      const std::size_t at = place.at({x, y});
      square.shows[at] = -1;
      for (int c = 0; c < 4; ++c) {
        square.share[static_cast<std::size_t>(c)][at] = static_cast<float>(shares.shares[pixel][c]) / 65535.0f;
      }
      square.weight[at] = shares.weights[pixel];
      square.mirror[at] = shares.mirrors[pixel];
      if (shares.rays[pixel] != rays) {
        rays = shares.rays[pixel];
        noise = noiseOf(rays);
      }
      square.noise[at] = noise;
    }
  }
  square.oneSurface = points.onlyNumberIn(place.all).has_value();
  if (square.oneSurface) return square;
  setSurfacesIn(points, place, square);
  square.oneSurface = showsOne(square, place);
  return square;
}

/// Calls `each(pixel, even, place in the square)` for the pixels of all squares that rays found something in.
void forEachEven(const PicturePoints& points, const SkyShares& shares, bool wide,
                 const std::function<void(std::uint32_t, const EvenSky&, std::size_t)>& each) {
  forEach(squareCount(shares.grid), [&](std::size_t number) {
    stopIfAsked();
    const SquarePlaceOf place = squareNumber(shares.grid, static_cast<int>(number));
    if (!anyShadow(shares, place.all)) return;
    const EvenSky even = evenOut(skySquare(points, shares, place), wide);
    for (int y = place.inner.y; y < place.inner.y + place.inner.height; ++y) {
      for (int x = place.inner.x; x < place.inner.x + place.inner.width; ++x) {
        const std::uint32_t pixel = shares.grid.numberOf({x, y});
        if (shares.rays[pixel] == 0) continue;
        each(pixel, even, static_cast<std::size_t>((y - place.corner.y) * kSkySide + x - place.corner.x));
      }
    }
  });
}

} // namespace

UnfilledVector<glm::u16vec4> evenedOut(const PicturePoints& points, const SkyShares& shares) {
  UnfilledVector<glm::u16vec4> values = shares.shares;
  forEachEven(points, shares, true, [&](std::uint32_t pixel, const EvenSky& even, std::size_t at) {
    for (int c = 0; c < 4; ++c) values[pixel][c] = unorm16(even.share[static_cast<std::size_t>(c)][at]);
  });
  return values;
}

std::vector<std::uint8_t> uneven(const PicturePoints& points, const SkyShares& shares) {
  constexpr float kUneven = 0.25f;
  std::vector<std::uint8_t> asked(shares.grid.pixels());
  forEachEven(points, shares, false, [&](std::uint32_t pixel, const EvenSky& even, std::size_t at) {
    if (even.uneven[at] > kUneven) asked[pixel] = 1;
  });
  return asked;
}

} // namespace gnomon
