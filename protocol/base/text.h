#pragma once

#include <cstddef>
#include <string>
#include <string_view>

/// Untrusted text made fit for a reply.
namespace gnomon {

/// True where `text` is well-formed UTF-8 (RFC 3629: no overlong forms, no surrogates, at most U+10FFFF).
bool isUtf8(std::string_view text);

/// `text` with each byte that is not part of well-formed UTF-8 replaced by '?'.
std::string asUtf8(std::string_view text);

/// The beginning of well-formed UTF-8 `text`, at most `maxBytes` long, with an ellipsis where something was left off.
std::string shortened(std::string_view text, std::size_t maxBytes);

} // namespace gnomon
