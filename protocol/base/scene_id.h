#pragma once

#include <algorithm>
#include <string_view>

namespace gnomon {

/// Whether this is what a server calls a scene: the SHA-256 of its upload, 64 lower-case hexadecimal digits.
inline bool isSceneId(std::string_view text) {
  const auto isDigit = [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); };
  return text.size() == 64 && std::all_of(text.begin(), text.end(), isDigit);
}

} // namespace gnomon
