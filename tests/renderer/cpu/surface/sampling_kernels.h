#pragma once

#include "renderer/cpu/surface/textures.h"
#include "tests/renderer/cpu/number_table.h"

namespace gnomon::cpu {

/// Columns that sampledByLanes takes: u, v, and how both move by a pixel to the right and up.
inline constexpr std::size_t kSamplingInputs = 6;

/// Red, green, blue and alpha of sampling-inl.h, and alpha read alone.
NumberTable sampledByLanes(const Texture& texture, const TextureUse& use, const NumberTable& in);

} // namespace gnomon::cpu
