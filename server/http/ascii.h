#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gnomon {

std::string lowerCase(std::string_view text);    ///< ASCII only
std::string_view trimmed(std::string_view text); ///< without spaces and tabs at the ends
std::string asciiExcerpt(std::string_view text); ///< to be quoted in a problem: at most 64 bytes, printable ASCII
std::string hexText(std::string_view bytes);     ///< two lower-case digits a byte
std::string base64Text(std::string_view bytes);  ///< RFC 4648 section 4, padded

/// The trimmed parts of `text` between separators; empty parts are kept, an empty text gives none.
std::vector<std::string> split(std::string_view text, char separator);

} // namespace gnomon
