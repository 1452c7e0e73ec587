#pragma once

#include <string>

#include "renderer/image/decoded_rows.h"
#include "renderer/image/image_container.h"

/// Each fills `to` from what essentialPng() and its like gave, and gives what is wrong with the data; empty = nothing.
/// No color is converted.
namespace gnomon {

/// What keeps a PNG's bytes from holding a picture at all; empty = nothing.
std::string unreadablePng(EncodedBytes essential);

/// 16 bits are rounded to 8. What can't be read is 0. Takes memory for a few rows of its own. REQUIRES: nothing is
/// unreadable.
std::string decodePng(EncodedBytes essential, DecodedRows& to);

/// Alpha is 255. What can't be read is grey.
std::string decodeJpeg(EncodedBytes essential, DecodedRows& to);

/// Straight alpha; where the picture has none, 255.
std::string decodeWebp(EncodedBytes essential, DecodedRows& to);

} // namespace gnomon
