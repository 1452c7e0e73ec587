#include "renderer/rays/pixel_places.h"

#include <bit>

#include "renderer/rays/light_source.h"

namespace gnomon {

PixelPlaces::PixelPlaces(std::uint32_t together, std::uint32_t most) {
  const std::uint32_t own = std::bit_ceil(together);
  for (std::uint32_t ray = 0; ray < most; ++ray) {
    const SquarePlace place = sequencePlace(ray);
    const SquarePlace within = sequencePlace(ray / own);
    const int finer = std::countr_zero(own) + 6;
    places_.push_back({place.x ^ within.x >> finer, place.y ^ within.y >> finer});
  }
  for (std::uint32_t i = 0; i < shifts_.size(); ++i) {
    const std::uint32_t x = i & 7;
    const std::uint32_t y = i >> 3;
    std::uint32_t pixel = 0;
    for (std::uint32_t bit = 0; bit < 3; ++bit)
      pixel |= ((x ^ y) >> bit & 1u) << 2 * bit | (y >> bit & 1u) << (2 * bit + 1);
    const SquarePlace place = sequencePlace(pixel * own);
    shifts_[i] = {place.x ^ 0x0c3375c9u, place.y ^ 0xc19953ddu};
  }
}

} // namespace gnomon
