#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string_view>

namespace gnomon {

/// How large untrusted JSON may be, so that no parser meets a text that would exhaust its stack or the memory.
struct JsonShape {
  int maxDepth = 0; ///< levels of objects and arrays
  std::size_t maxValues = std::numeric_limits<std::size_t>::max();
};

/// Where a text leaves its bounds.
struct JsonExcess {
  enum class Of { depth, values } of = Of::depth;
  std::size_t offset = 0; ///< of the first byte too much
};

/// Counts brackets and commas outside strings, before anything is parsed: the text need not be JSON. Nothing = within
/// the bounds.
std::optional<JsonExcess> findExcess(std::string_view text, const JsonShape& bounds);

} // namespace gnomon
