#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "renderer/image/image.h"

namespace gnomon {

/// The scheme of a URI (RFC 3986, 3.1) in lower case, or nothing for a relative reference.
std::string schemeOf(std::string_view uri);

/// Undoes %41; nothing if an escape is broken.
std::optional<std::string> decodePercent(std::string_view text);

/// RFC 4648, section 4; the padding may be missing. Nothing if a character is foreign.
std::optional<Bytes> decodeBase64(std::string_view text);

} // namespace gnomon
