#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "protocol/base/bytes.h"

/// Bytes written as plain text, and read back.
namespace gnomon {

/// Two lower-case hexadecimal digits for each byte.
std::string hexText(std::span<const std::uint8_t> bytes);

/// Base64 of RFC 4648, section 4, padded, without line breaks.
std::string base64Text(std::span<const std::uint8_t> bytes);

enum class Base64Padding { required, optional };

/// The bytes that a base64 text stands for; nothing if a character or the length is wrong.
std::optional<Bytes> base64Bytes(std::string_view text, Base64Padding padding = Base64Padding::required);

/// `text` with its percent escapes decoded (RFC 3986, section 2.1); nothing if an escape is broken.
std::optional<std::string> percentDecoded(std::string_view text);

/// The scheme of a URI (RFC 3986, section 3.1) in lower case; empty for a relative reference.
std::string schemeOf(std::string_view uri);

} // namespace gnomon
