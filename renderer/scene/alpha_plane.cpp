#include "renderer/scene/alpha_plane.h"

#include <algorithm>
#include <numeric>
#include <utility>
#include <variant>

#include "renderer/image/between_texels.h"

namespace gnomon {
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
  const std::vector<BetweenTexels> across = betweenTexels(width_, half.width_);
  const std::vector<BetweenTexels> down = betweenTexels(height_, half.height_);
  for (std::size_t row = 0; row < down.size(); ++row) {
    const BetweenTexels& y = down[row];
    for (std::size_t column = 0; column < across.size(); ++column) {
      const BetweenTexels& x = across[column];
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
