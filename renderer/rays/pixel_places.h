#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace gnomon {

/// Places of the unit square for the rays of each pixel, in units of 2^-32. Each pixel of a square of 8 x 8 has those
/// of a block of Sobol's sequence: its rays are even over the square, and lie between those of the other pixels,
/// already of 2 x 2 and of 4 x 4 pixels (Keller and Heidrich, "Interleaved Sampling", 2001). Later rays of a pixel are
/// even over the square, too, whether or not those around send any: they go close to where others' first rays go.
class PixelPlaces {
 public:
  /// `together`: how many rays each pixel sends at first; `most`: in all.
  PixelPlaces(std::uint32_t together, std::uint32_t most);

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
