#pragma once

#include <optional>
#include <string_view>

#include "renderer/image/image.h"

namespace gnomon::cli {

/// RFC 4648 section 4, padded, without line breaks; nothing when the text is anything else.
std::optional<Bytes> base64Decoded(std::string_view text);

} // namespace gnomon::cli
