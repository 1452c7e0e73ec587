#pragma once

#include <array>
#include <cstdint>

#include "renderer/cpu/show/show_view.h"

namespace gnomon::cpu {

/// The pixels of a square in TileColors' order, R G B or R G B A. Each four of a row begin 16 bytes behind those
/// before.
struct TileBytes {
  alignas(64) std::array<std::uint8_t, 4 * kTilePixels> pixels;
};

/// Linear colors to sRGB bytes, rounded right (IEC 61966-2-1); alpha stays linear. What lies beyond 0..1 is clipped.
/// `channels`: 3 or 4.
TileBytes srgbBytes(const TileColors& colors, std::size_t channels);

} // namespace gnomon::cpu
