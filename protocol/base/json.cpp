#include "protocol/base/json.h"

#include "protocol/base/text.h"

namespace gnomon {

std::string escapedToken(std::string_view key) {
  std::string token;
  token.reserve(key.size());
  for (const char c : key) {
    if (c == '~') {
      token += "~0";
    } else if (c == '/') {
      token += "~1";
    } else {
      token += c;
    }
  }
  return token;
}

std::string pointerSegment(std::string_view key) {
  constexpr std::size_t kMaxKeyBytes = 100;
  return "/" + escapedToken(shortened(key, kMaxKeyBytes));
}

std::string Place::pointer() const {
  if (!parent_) return "";
  return parent_->pointer() + (isIndex_ ? "/" + std::to_string(index_) : pointerSegment(key_));
}

bool pointsInto(std::string_view inner, std::string_view outer) {
  return inner.starts_with(outer) && (inner.size() == outer.size() || inner[outer.size()] == '/');
}

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
