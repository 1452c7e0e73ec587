#include "renderer/scene/alpha_plane.h"

#include <algorithm>
#include <variant>

namespace gnomon {
namespace {

std::size_t squaresOf(std::size_t texels, std::size_t side) {
  return (texels + side - 1) / side;
}

} // namespace

AlphaPlane::AlphaPlane(const Image& image) : width_(image.width), height_(image.height) {
  const auto width = static_cast<std::size_t>(image.width);
  const auto height = static_cast<std::size_t>(image.height);
  const std::uint8_t* alpha = std::get<std::vector<std::uint8_t>>(image.pixels).data() + 3;
  squaresAcross_ = squaresOf(width, kSide);
  texels_.resize(squaresAcross_ * squaresOf(height, kSide) * kSide * kSide);
  for (std::size_t row = 0; row < height; ++row) {
    for (std::size_t first = 0; first < width; first += kSide) {
      const std::size_t count = std::min(kSide, width - first);
      std::uint8_t* to = &texels_[(row / kSide * squaresAcross_ + first / kSide) * kSide * kSide + row % kSide * kSide];
      for (std::size_t i = 0; i < count; ++i) to[i] = alpha[4 * (row * width + first + i)];
    }
  }
}

} // namespace gnomon
