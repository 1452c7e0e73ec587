#include "protocol/base/json_pointer.h"

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

} // namespace gnomon
