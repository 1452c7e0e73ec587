#pragma once

#include <string>

#include "renderer/image/decoded_rows.h"
#include "renderer/image/image_container.h"

namespace gnomon {

/// Fills `to` from what essentialJpeg() gave; alpha is 255. Gives what went wrong, in the library's words; empty =
/// nothing. What can't be read then is grey.
std::string decodeJpeg(EncodedBytes essential, DecodedRows& to);

} // namespace gnomon
