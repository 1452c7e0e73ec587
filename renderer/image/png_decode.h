#pragma once

#include <string>

#include "renderer/image/decoded_rows.h"
#include "renderer/image/image_container.h"

namespace gnomon {

/// What keeps essentialPng()'s bytes from holding a picture at all; empty = nothing.
std::string unreadablePng(EncodedBytes essential);

/// Fills `to` from them: 16 bits are rounded to 8, no colour is converted. Gives what is wrong with the data; empty =
/// nothing. What can't be read then is 0. Takes memory for a few rows of its own. REQUIRES: nothing is unreadable.
std::string decodePng(EncodedBytes essential, DecodedRows& to);

} // namespace gnomon
