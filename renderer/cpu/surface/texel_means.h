#pragma once

#include <cstddef>
#include <cstdint>

#include "renderer/cpu/surface/pyramid.h"

namespace gnomon::cpu {

/// Rows `first` to `last` of the next smaller level, whose texels are the means of four of `from`: in linear light
/// where the texture is sRGB. `to`: the place of its row 0. REQUIRES: the sides of `from` are even.
void meanRows(const TextureLevel& from, bool srgb, std::size_t first, std::size_t last, std::uint32_t* to);

/// All of the next smaller level, of this size: where a side of `from` is odd, of texels mixed from the two around
/// them.
void halve(const TextureLevel& from, const TextureLevel& size, bool srgb, std::uint32_t* to);

} // namespace gnomon::cpu
