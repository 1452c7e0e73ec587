#pragma once

#include <string>

#include "renderer/image/image_container.h"

namespace gnomon {

/// Fills `rgba`, width * height * 4 bytes, from what essentialPng() gave: 16 bits are rounded to 8, no colour is
/// converted. Gives what is wrong with the data; empty = nothing. Takes memory for a few rows beside `rgba`.
std::string decodePng(EncodedBytes essential, const ImageSize& size, std::uint8_t* rgba);

} // namespace gnomon
