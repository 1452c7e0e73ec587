#include <algorithm>

#include "renderer/core/parallel.h"
#include "renderer/techniques/picture_shares.h"
#include "renderer/techniques/share_square.h"

namespace gnomon {
namespace {

constexpr int kSide = ShareSquare::kSide;
constexpr int kReach = ShareSquare::kReach;

bool hadRounds(const PictureShares& shares, std::uint32_t pixel) {
  return shares.marks[pixel] >= PictureShares::kRound;
}

bool anyHadRounds(const PictureShares& shares, const Rect& square) {
  for (int y = square.y; y < square.y + square.height; ++y) {
    for (int x = square.x; x < square.x + square.width; ++x) {
      if (hadRounds(shares, shares.grid.numberOf({x, y}))) return true;
    }
  }
  return false;
}

Rect within(const SampleGrid& grid, const Rect& square, int around) {
  const int left = std::max(square.x - around, 0);
  const int lowest = std::max(square.y - around, 0);
  return {left, lowest, std::min(square.x + kSide + around, grid.width) - left,
          std::min(square.y + kSide + around, grid.height) - lowest};
}

/// Sets `square.shows` where a pixel of the square that had rounds is compared to what is there. `inner`: those of the
/// square that lie in the picture; `all`: those around it, too.
void setCompared(const PictureShares& shares, const Rect& inner, const Rect& all, const glm::ivec2& corner,
                 ShareSquare& square) {
  std::fill_n(square.shows, ShareSquare::kCount, 0);
  for (int y = inner.y; y < inner.y + inner.height; ++y) {
    for (int x = inner.x; x < inner.x + inner.width; ++x) {
      if (!hadRounds(shares, shares.grid.numberOf({x, y}))) continue;
      const int left = std::max(x - kReach, all.x);
      const int right = std::min(x + kReach + 1, all.x + all.width);
      for (int row = std::max(y - kReach, all.y); row < std::min(y + kReach + 1, all.y + all.height); ++row) {
        std::fill_n(square.shows + (row - corner.y) * ShareSquare::kWidth + left - corner.x, right - left, -1);
      }
    }
  }
}

/// Sets where the pixels lie that `square.shows`. `all`: the square and those around it, as far as the picture goes.
void setSurfaces(const PicturePoints& points, const Rect& all, const glm::ivec2& corner, ShareSquare& square) {
  const auto placeOf = [&](const glm::ivec2& pixel) {
    return static_cast<std::size_t>((pixel.y - corner.y) * ShareSquare::kWidth + pixel.x - corner.x);
  };
  ShownSamples waiting;
  const auto put = [&] {
    const DrawnSurfaces surfaces = points.surfaces(points.drawn(waiting));
    for (std::size_t i = 0; i < waiting.count; ++i) {
      const std::size_t place = placeOf(waiting.pixels[i]);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        square.point[axis][place] = surfaces.relative[axis][i];
        square.normal[axis][place] = surfaces.normal[axis][i];
      }
    }
    waiting.count = 0;
  };
  forEachPixel(points.grid(), all, [&](const glm::ivec2& pixel) {
    if (square.shows[placeOf(pixel)] == 0) return;
    waiting.add(pixel, 0, points.numberAt(pixel));
    if (waiting.full()) put();
  });
  if (waiting.count > 0) put();
}

/// As if all pixels showed one point.
void setOneSurface(ShareSquare& square) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::fill_n(square.point[axis], ShareSquare::kCount, 0.0f);
    std::fill_n(square.normal[axis], ShareSquare::kCount, axis == 0 ? 1.0f : 0.0f);
  }
}

ShareSquare squareAt(const PicturePoints& points, std::span<const int> raysOf, const PictureShares& shares,
                     const Rect& inner) {
  const SampleGrid& grid = shares.grid;
  ShareSquare square;
  std::fill_n(square.share, ShareSquare::kCount, 0.0f);
  std::fill_n(square.noise, ShareSquare::kCount, 0.0f);
  const glm::ivec2 corner(inner.x - kReach, inner.y - kReach);
  const Rect all = within(grid, inner, kReach);
  setCompared(shares, within(grid, inner, 0), all, corner, square);
  for (int y = all.y; y < all.y + all.height; ++y) {
    const std::size_t row = static_cast<std::size_t>((y - corner.y) * ShareSquare::kWidth);
    for (int x = all.x; x < all.x + all.width; ++x) {
      const std::size_t place = row + static_cast<std::size_t>(x - corner.x);
      const std::uint32_t pixel = grid.numberOf({x, y});
      const bool away = (shares.marks[pixel] & PictureShares::kAway) != 0;
      square.share[place] = static_cast<float>(*shares.valuesOf(pixel)) / 65535.0f;
      if (away || points.numberAt({x, y}) == kNoNumber) square.shows[place] = 0;
      if (hadRounds(shares, pixel))
        square.noise[place] = noiseOf(raysOf[shares.marks[pixel] / PictureShares::kRound - 1u]);
    }
  }
  setOneSurface(square);
  if (!points.onlyNumberIn(all)) setSurfaces(points, all, corner, square);
  return square;
}

struct EvenShare {
  std::uint32_t pixel;
  float share;
};

/// Of all pixels that had rounds, square by square.
std::vector<std::vector<EvenShare>> evenShares(const PicturePoints& points, std::span<const int> raysOf,
                                               const PictureShares& shares) {
  const SampleGrid& grid = shares.grid;
  const int columns = (grid.width + kSide - 1) / kSide;
  const int rows = (grid.height + kSide - 1) / kSide;
  std::vector<std::vector<EvenShare>> found(static_cast<std::size_t>(columns * rows));
  forEach(found.size(), [&](std::size_t number) {
    const int i = static_cast<int>(number);
    const Rect inner{i % columns * kSide, i / columns * kSide, kSide, kSide};
    const Rect shown = within(grid, inner, 0);
    if (!anyHadRounds(shares, shown)) return;
    const EvenSquare even = evenOut(squareAt(points, raysOf, shares, inner));
    for (int y = shown.y; y < shown.y + shown.height; ++y) {
      for (int x = shown.x; x < shown.x + shown.width; ++x) {
        const std::uint32_t pixel = grid.numberOf({x, y});
        const std::size_t place = static_cast<std::size_t>((y - inner.y) * kSide + x - inner.x);
        if (hadRounds(shares, pixel)) found[number].push_back({pixel, even.share[place]});
      }
    }
  });
  return found;
}

} // namespace

void evenOut(const PicturePoints& points, std::span<const int> raysOf, PictureShares& shares) {
  const auto found = evenShares(points, raysOf, shares);
  forEach(found.size(), [&](std::size_t square) {
    for (const EvenShare& even : found[square]) shares.set(even.pixel, even.share);
  });
}

} // namespace gnomon
