#include "protocol/base/json_shape.h"

namespace gnomon {

std::optional<JsonExcess> findExcess(std::string_view text, const JsonShape& bounds) {
  int depth = 0;
  std::size_t values = 1;
  bool inString = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (inString) {
      if (c == '\\') {
        ++i;
      } else if (c == '"') {
        inString = false;
      }
      continue;
    }
    if (c == '"') {
      inString = true;
    } else if (c == '[' || c == '{') {
      ++values;
      if (++depth > bounds.maxDepth) return JsonExcess{JsonExcess::Of::depth, i};
    } else if (c == ']' || c == '}') {
      --depth;
    } else if (c == ',') {
      ++values;
    }
    if (values > bounds.maxValues) return JsonExcess{JsonExcess::Of::values, i};
  }
  return std::nullopt;
}

} // namespace gnomon
