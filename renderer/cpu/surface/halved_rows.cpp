#include "renderer/cpu/surface/halved_rows.h"

#include <algorithm>
#include <bit>

#include "renderer/cpu/surface/texel_means.h"
#include "renderer/image/picture_decode.h"

namespace gnomon::cpu {
std::size_t evenLevels(const ImageSize& size) {
  return static_cast<std::size_t>(std::countr_zero(static_cast<unsigned>(size.width | size.height)));
}

HalvedRows::HalvedRows(const ImageSize& size, bool srgb, std::size_t level)
    : width_(static_cast<std::size_t>(size.width)),
      srgb_(srgb),
      level_(level),
      atOnce_(std::max(DecodedRows::kStep, 1 << level)),
      texels_(std::make_shared<Pyramid::Texels>((width_ >> level) * (static_cast<std::size_t>(size.height) >> level))) {
  for (std::size_t i = 1; i < level; ++i) {
    between_.emplace_back((width_ >> i) * (static_cast<std::size_t>(atOnce_) >> i));
  }
}

void HalvedRows::add(int first, std::span<const std::uint8_t> rgba) {
  const auto* texels = reinterpret_cast<const std::uint32_t*>(rgba.data()); // as pyramidOf()
  const std::size_t rows = rgba.size() / (4 * width_), few = static_cast<std::size_t>(atOnce_);
  for (std::size_t row = 0; row < rows; row += few) {
    addFew(static_cast<std::size_t>(first) + row, texels + row * width_, std::min(few, rows - row));
  }
}

void HalvedRows::addFew(std::size_t first, const std::uint32_t* texels, std::size_t rows) {
  std::uint32_t* const place = texels_->data() + (first >> level_) * (width_ >> level_);
  if (level_ == 0) {
    std::copy_n(texels, rows * width_, place);
    return;
  }
  const auto levelOf = [&](std::size_t i, const std::uint32_t* of) {
    return TextureLevel{of, static_cast<int>(width_ >> i), static_cast<int>(rows >> i)};
  };
  for (std::size_t i = 1; i <= level_; ++i) {
    std::uint32_t* const to = i == level_ ? place : between_[i - 1].data();
    halve(levelOf(i - 1, texels), levelOf(i, to), srgb_, to);
    texels = to;
  }
}

} // namespace gnomon::cpu
