#include "renderer/cpu/surface/pyramid.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "renderer/cpu/surface/texel_means.h"
#include "renderer/image/picture_decode.h"

namespace gnomon::cpu {

std::size_t levelsOf(int width, int height) {
  return static_cast<std::size_t>(std::bit_width(static_cast<unsigned>(std::max(width, height))));
}

Pyramid pyramidOf(const ImageSize& size, bool srgb, GivenLevel from, std::size_t finest, const Pyramid& known) {
  const std::size_t count = levelsOf(size.width, size.height);
  Pyramid pyramid{srgb, finest, std::vector<TextureLevel>(count), {}};
  pyramid.owned.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    pyramid.levels[i].width = std::max(size.width >> i, 1);
    pyramid.levels[i].height = std::max(size.height >> i, 1);
  }
  for (std::size_t i = from.level;; ++i) {
    if (i >= finest) {
      pyramid.levels[i].texels = from.texels;
      pyramid.owned[i] = from.owned;
    }
    if (i + 1 == count) return pyramid;
    if (i + 1 < known.levels.size() && i + 1 >= known.finest) {
      from.owned = known.owned[i + 1];
    } else {
      const TextureLevel larger{from.texels, pyramid.levels[i].width, pyramid.levels[i].height};
      const TextureLevel& smaller = pyramid.levels[i + 1];
      auto texels = std::make_shared<Pyramid::Texels>(static_cast<std::size_t>(smaller.width) *
                                                      static_cast<std::size_t>(smaller.height));
      halve(larger, smaller, srgb, texels->data());
      from.owned = std::move(texels);
    }
    from.texels = from.owned->data();
  }
}

Pyramid pyramidOf(const Image& image, bool srgb, std::size_t finest, const Pyramid& known) {
  // The first byte is red, in the lowest place: so it is where memory is little-endian, as everywhere that this runs.
  const auto& pixels = std::get<std::vector<std::uint8_t>>(image.pixels);
  const auto* texels = reinterpret_cast<const std::uint32_t*>(pixels.data());
  return pyramidOf({image.width, image.height}, srgb, {0, texels, nullptr}, finest, known);
}

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
