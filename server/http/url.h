#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "protocol/base/result.h"

namespace gnomon {

using Query = std::vector<std::pair<std::string, std::string>>; ///< keys and values, decoded, in order

struct Url {
  std::vector<std::string> path; ///< decoded segments; "/" has none; "." and ".." are refused
  Query query;                   ///< "a" means ("a", "")
};

/// A request target in origin form ("/a/b?c=d"). Decoded text holds no control characters.
Result<Url> parseTarget(std::string_view target);

/// Percent-decoding; with `plusIsSpace` as in a query string. A broken or control-character escape is malformed.
Result<std::string> decodeUrlText(std::string_view text, bool plusIsSpace);

} // namespace gnomon
