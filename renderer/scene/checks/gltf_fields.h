#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <string_view>

namespace gnomon {

/// What a member of a glTF object holds.
enum class FieldKind {
  boolean,
  number,
  integer, ///< a whole number
  string,
  numbers,    ///< an array of `length` numbers
  numberRows, ///< an array of `rows` such arrays
  strings,
  reference,     ///< an index into the root array `of`
  references,    ///< an array of them, none twice
  referenceRows, ///< an array of arrays of `length` of them
  referenceMap,  ///< an object whose values are references
  referenceMaps,
  integerMap, ///< an object whose values are whole numbers
  object,     ///< described by the rows whose owner is `of`
  objects
};

/// One member of a kind of glTF object.
struct GltfField {
  std::string_view owner;
  std::string_view key;
  FieldKind kind = FieldKind::string;
  std::string_view of = {};
  bool required = false;
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool minExcluded = false;
  std::size_t length = 0;        ///< 0 = any
  std::size_t rows = 0;          ///< 0 = any
  std::string_view allowed = {}; ///< of integers and strings: the values, with a space between each two
  bool noDefault = false;        ///< another value than those does not count as if the member were not there
};

/// Every member that is read, grouped by owner; the owner of the root's members is "root".
std::span<const GltfField> gltfFields();

} // namespace gnomon
