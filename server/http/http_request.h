#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "renderer/image/image.h"

namespace gnomon {

/// A header as it came; names are lower case.
using Headers = std::vector<std::pair<std::string, std::string>>;

/// One request, every byte of it bounded and checked for its form.
struct HttpRequest {
  std::string id;                ///< X-Request-ID: the client's if it is well formed, else made
  std::string method;            ///< upper case
  std::vector<std::string> path; ///< percent-decoded segments; "/" has none
  std::vector<std::pair<std::string, std::string>> query; ///< percent-decoded, in order
  Headers headers;
  Bytes body;
};

/// The values of header `name` (lower case), joined by ", " when it came several times.
inline std::optional<std::string> headerValue(const Headers& headers, std::string_view name) {
  std::optional<std::string> value;
  for (const auto& [key, text] : headers) {
    if (key == name) {
      value = value ? *value + ", " + text : text;
    }
  }
  return value;
}

inline std::string_view textOf(const Bytes& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

} // namespace gnomon
