#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "protocol/base/result.h"

/// Places in a JSON document, and how large one may be. Reading one: protocol/json/json_source.h.
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

/// A step into JSON: the name of an object's member, or the index of a list's element.
using FieldStep = std::variant<std::string, std::size_t>;

/// The steps of a field's path as FIELDS.md shows it, each list's element with its index in brackets:
/// "lights[0].sun.azimuthDegrees". A part that is a number by itself is an index, too: "lights.0.sun". At least one
/// step. Problems: brackets that hold no index of up to 9 digits, or follow no name.
Result<std::vector<FieldStep>> fieldSteps(std::string_view path);

/// The JSON pointer of such a place: "/lights/0/sun/azimuthDegrees".
std::string pointerOf(const std::vector<FieldStep>& steps);

/// The path of a JSON pointer: "/lights/0/type" gives "lights[0].type".
std::string fieldPath(std::string_view pointer);

} // namespace gnomon
