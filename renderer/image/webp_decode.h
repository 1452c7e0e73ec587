#pragma once

#include <string>

#include "renderer/image/image_container.h"

namespace gnomon {

/// Fills `rgba`, width * height * 4 bytes, from what essentialWebp() gave: straight alpha, no color conversion; where
/// the picture has no alpha, 255. Gives what went wrong; empty = nothing.
std::string decodeWebp(EncodedBytes essential, const ImageSize& size, std::uint8_t* rgba);

} // namespace gnomon
