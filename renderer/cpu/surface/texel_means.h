#pragma once

#include <cstdint>

#include "renderer/cpu/surface/pyramid.h"

namespace gnomon::cpu {

/// The next smaller level, of this size. Its texels are the means of four of `from`, in linear light where the texture
/// is sRGB; where a side of `from` is odd, they are mixed from the two around them.
void halve(const TextureLevel& from, const TextureLevel& size, bool srgb, std::uint32_t* to);

} // namespace gnomon::cpu
