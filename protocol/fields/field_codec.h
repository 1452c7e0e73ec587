#pragma once

#include <initializer_list>
#include <optional>
#include <string_view>
#include <utility>

#include "protocol/fields/value_type.h"

/// Described structs from JSON and to JSON.
namespace gnomon {

/// Adds the problems that it finds, writes `out` only where the value can be taken, and returns whether it was.
bool decodeValue(const JsonNode& node, const Notes& notes, const Place& place, ProblemList& problems,
                 const ValueType& type, void* out);

template <class T>
bool decodeValue(const JsonNode& node, const Notes& notes, const Place& place, ProblemList& problems, T& out) {
  return decodeValue(node, notes, place, problems, typeOf<T>(), &out);
}

/// Adds the problem of a value that is not `expected`; false.
bool addWrongType(const JsonNode& node, std::string_view expected, const Place& place, ProblemList& problems);

/// Every key of a struct's JSON object, those of inlined structs included.
void appendKeys(const StructType& type, std::vector<std::string_view>& keys);

/// What `out` is in untrusted JSON; members that are absent keep their values. Every problem, with its pointer.
Problems decodeJson(std::string_view json, const ValueType& type, void* out);

template <class T>
Result<T> decodeJson(std::string_view json) {
  T value;
  Problems problems = decodeJson(json, typeOf<T>(), &value);
  if (problems.empty()) return value;
  return problems;
}

/// A reply that a server wrote; what it says beyond our rows is passed over. False = one of `keys` is missing.
bool readReply(std::string_view json, std::initializer_list<const char*> keys, const ValueType& type, void* out);

template <class T>
std::optional<T> readReply(std::string_view json, std::initializer_list<const char*> keys) {
  T value;
  return readReply(json, keys, typeOf<T>(), &value) ? std::optional(std::move(value)) : std::nullopt;
}

Json encodeValue(const ValueType& type, const void* value);

/// As Json: keys in the rows' order, absent fields left out; reading it back gives the same value.
template <class T>
auto toJson(const T& value) {
  return encodeValue(typeOf<T>(), &value);
}

} // namespace gnomon
