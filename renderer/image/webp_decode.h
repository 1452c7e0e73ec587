#pragma once

#include <string>

#include "renderer/image/decoded_rows.h"
#include "renderer/image/image_container.h"

namespace gnomon {

/// Fills `to` from what essentialWebp() gave: straight alpha, no color conversion; where the picture has no alpha, 255.
/// Gives what went wrong; empty = nothing.
std::string decodeWebp(EncodedBytes essential, DecodedRows& to);

} // namespace gnomon
