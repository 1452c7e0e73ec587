#include "protocol/base/place.h"

#include "protocol/base/text.h"

namespace gnomon {

std::string pointerSegment(std::string_view key) {
  constexpr std::size_t kMaxKeyBytes = 100;
  std::string segment = "/";
  for (const char c : shortened(key, kMaxKeyBytes)) {
    if (c == '~') {
      segment += "~0";
    } else if (c == '/') {
      segment += "~1";
    } else {
      segment += c;
    }
  }
  return segment;
}

std::string Place::pointer() const {
  if (!parent_) return "";
  return parent_->pointer() + (isIndex_ ? "/" + std::to_string(index_) : pointerSegment(key_));
}

bool pointsInto(std::string_view inner, std::string_view outer) {
  return inner.starts_with(outer) && (inner.size() == outer.size() || inner[outer.size()] == '/');
}

} // namespace gnomon
