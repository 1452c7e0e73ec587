#pragma once

#include <array>
#include <cstdint>

#include "renderer/cpu/show/show_view.h"

namespace gnomon::cpu {

/// The pixels of a square in TileColors' order: R in the lowest byte, then G, B and A.
struct TileBytes {
  alignas(64) std::array<std::uint32_t, kTilePixels> pixels;
};

/// Linear colors to sRGB bytes, rounded right (IEC 61966-2-1); alpha stays linear. What lies beyond 0..1 is clipped.
void srgbBytes(const TileColors& colors, TileBytes& bytes);

} // namespace gnomon::cpu
