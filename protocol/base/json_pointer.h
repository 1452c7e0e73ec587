#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace gnomon {

/// A place in a JSON document: a chain of keys and indices on the stack, written out only when a problem needs it.
class Place {
 public:
  Place() = default;
  Place(const Place& parent, std::string_view key) : parent_(&parent), key_(key) {}
  Place(const Place& parent, std::size_t index) : parent_(&parent), index_(index), isIndex_(true) {}

  /// RFC 6901; "" = the whole document. A very long key is shortened.
  std::string pointer() const;

 private:
  const Place* parent_ = nullptr;
  std::string_view key_;
  std::size_t index_ = 0;
  bool isIndex_ = false;
};

/// `key` as a token of a JSON pointer: '~' and '/' are escaped.
std::string escapedToken(std::string_view key);

/// One "/key" of a JSON pointer, escaped, and shortened where it is very long.
std::string pointerSegment(std::string_view key);

/// True where `inner` is `outer` or lies within it. Both are JSON pointers.
bool pointsInto(std::string_view inner, std::string_view outer);

} // namespace gnomon
