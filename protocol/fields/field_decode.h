#pragma once

#include <string_view>

#include "protocol/fields/value_type.h"

/// JSON to described structs. Each function adds the problems that it finds, writes `out` only where the value can be
/// taken, and returns whether it was.
namespace gnomon {

bool decodeValue(const JsonNode& node, const Notes& notes, const Place& place, ProblemList& problems,
                 const ValueType& type, void* out);

template <class T>
bool decodeValue(const JsonNode& node, const Notes& notes, const Place& place, ProblemList& problems, T& out) {
  return decodeValue(node, notes, place, problems, typeOf<T>(), &out);
}

/// The problem of a value that is not `expected`.
void addWrongType(const JsonNode& node, std::string_view expected, const Place& place, ProblemList& problems);

/// Every key of a struct's JSON object, those of inlined structs included.
void appendKeys(const StructType& type, std::vector<std::string_view>& keys);

} // namespace gnomon
