#include "renderer/cpu/surface/pyramid.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "renderer/cpu/surface/texel_means.h"

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

} // namespace gnomon::cpu
