#pragma once

#include <string>

#include "renderer/image/decoded_rows.h"
#include "renderer/image/image_container.h"

namespace gnomon {

/// Fills `to` from what essentialPng() gave: 16 bits are rounded to 8, no colour is converted. Gives what is wrong with
/// the data; empty = nothing. Takes memory for a few rows of its own.
std::string decodePng(EncodedBytes essential, DecodedRows& to);

} // namespace gnomon
