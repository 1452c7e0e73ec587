#include "renderer/scene/alpha_plane.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <variant>

namespace gnomon {
namespace {

/// Which two texels of a side one of the next level lies between, and the second one's share.
struct Between {
  std::size_t first = 0, second = 0;
  double share = 0;
};

std::vector<Between> betweenTexels(int from, int to) {
  std::vector<Between> all(static_cast<std::size_t>(to));
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double place = (static_cast<double>(i) + 0.5) * from / to - 0.5;
    const double below = std::floor(place);
    const auto first = static_cast<std::size_t>(std::max(below, 0.0));
    all[i] = {first, std::min(first + 1, static_cast<std::size_t>(from) - 1), place - below};
  }
  return all;
}

} // namespace

AlphaPlane::AlphaPlane(int width, int height)
    : width_(width),
      height_(height),
      squaresAcross_(squaresOf(width)),
      texels_(squaresAcross_ * squaresOf(height) * kSide * kSide) {}

AlphaPlane::AlphaPlane(const Image& image) : AlphaPlane(image.width, image.height) {
  const auto width = static_cast<std::size_t>(image.width);
  const auto height = static_cast<std::size_t>(image.height);
  const std::uint8_t* alpha = std::get<std::vector<std::uint8_t>>(image.pixels).data() + 3;
  for (std::size_t row = 0; row < height; ++row) {
    for (std::size_t first = 0; first < width; first += kSide) {
      const std::size_t count = std::min(kSide, width - first);
      std::uint8_t* to = &texels_[placeOf(first, row)];
      for (std::size_t i = 0; i < count; ++i) to[i] = alpha[4 * (row * width + first + i)];
    }
  }
}

AlphaPlane AlphaPlane::halved() const {
  AlphaPlane half(std::max(width_ / 2, 1), std::max(height_ / 2, 1));
  const std::vector<Between> across = betweenTexels(width_, half.width_), down = betweenTexels(height_, half.height_);
  for (std::size_t row = 0; row < down.size(); ++row) {
    const Between& y = down[row];
    for (std::size_t column = 0; column < across.size(); ++column) {
      const Between& x = across[column];
      const double above = at(x.first, y.first) * (1 - x.share) + at(x.second, y.first) * x.share;
      const double below = at(x.first, y.second) * (1 - x.share) + at(x.second, y.second) * x.share;
      half.texels_[half.placeOf(column, row)] =
          static_cast<std::uint8_t>(above * (1 - y.share) + below * y.share + 0.5);
    }
  }
  return half;
}

AlphaLevels::AlphaLevels(AlphaPlane largest) {
  levels_.push_back(std::move(largest));
  while (levels_.back().width() > 1 || levels_.back().height() > 1) levels_.push_back(levels_.back().halved());
}

std::size_t AlphaLevels::bytes() const {
  return std::accumulate(levels_.begin(), levels_.end(), std::size_t{0},
                         [](std::size_t sum, const AlphaPlane& level) { return sum + level.bytes(); });
}

} // namespace gnomon
