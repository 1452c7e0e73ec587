#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace gnomon {

/// Places of the unit square for the rays of each pixel, in units of 2^-32. A pixel's are the first ones of Sobol's
/// sequence, XORed with a shift of its own; there is one for each pixel of a square of 8 x 8, so that the rays of a
/// square lie between each other, those of 2 x 2 and of 4 x 4 pixels, too (Keller and Heidrich, "Interleaved Sampling",
/// 2001).
class PixelPlaces {
 public:
  explicit PixelPlaces(std::uint32_t rays); ///< most of a pixel

  struct Place {
    std::uint32_t x, y;
  };
  Place of(std::uint32_t x, std::uint32_t y, std::uint32_t ray) const {
    const Place& shift = shifts_[(y & 7) << 3 | (x & 7)];
    return {places_[ray].x ^ shift.x, places_[ray].y ^ shift.y};
  }

 private:
  std::array<Place, 64> shifts_;
  std::vector<Place> places_;
};

} // namespace gnomon
