#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon::cpu {

inline constexpr int kPartSide = 8;       ///< pixels
inline constexpr unsigned kPartCount = 4; ///< of a square of the picture, two by two, from the lower left one

/// The parts of a picture that see all of a light, as far as that is known without its tiles' texels. Squares count
/// row by row from the BOTTOM.
class LitParts {
 public:
  LitParts() = default; ///< of no light
  LitParts(std::size_t lights, int squaresAcross, int squaresUp)
      : across_(squaresAcross),
        up_(squaresUp),
        bits_(lights * static_cast<std::size_t>(squaresAcross) * static_cast<std::size_t>(squaresUp)) {}

  /// A bit for each part of a square; none outside of the picture.
  unsigned of(std::size_t light, int column, int row) const {
    const bool inside = column >= 0 && row >= 0 && column < across_ && row < up_;
    return inside ? bits_[placeOf(light, column, row)] : 0u;
  }
  void add(std::size_t light, int column, int row, unsigned parts) {
    bits_[placeOf(light, column, row)] |= static_cast<std::uint8_t>(parts);
  }

 private:
  std::size_t placeOf(std::size_t light, int column, int row) const {
    return (light * static_cast<std::size_t>(up_) + static_cast<std::size_t>(row)) * static_cast<std::size_t>(across_) +
           static_cast<std::size_t>(column);
  }

  int across_ = 0, up_ = 0;
  std::vector<std::uint8_t> bits_;
};

} // namespace gnomon::cpu
