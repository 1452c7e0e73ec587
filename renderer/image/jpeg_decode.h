#pragma once

#include <string>

#include "renderer/image/image_container.h"

namespace gnomon {

/// Fills `rgba`, width * height * 4 bytes, from what essentialJpeg() gave; alpha is 255. Gives what went wrong, in the
/// library's words; empty = nothing. Whatever the library so much as warns about is an error.
std::string decodeJpeg(EncodedBytes essential, const ImageSize& size, std::uint8_t* rgba);

} // namespace gnomon
