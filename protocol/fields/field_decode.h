#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "protocol/base/json_pointer.h"
#include "protocol/base/problem_list.h"
#include "protocol/fields/field_checks.h"
#include "protocol/fields/fields.h"
#include "protocol/fields/spellings.h"
#include "protocol/json/json_source.h"

/// JSON to described structs. Each function adds the problems that it finds, writes `out` only where the value can be
/// taken, and tells whether it was.
namespace gnomon {

bool decodeValue(const JsonNode& node, const Notes& notes, const Place& place, ProblemList& problems, bool& out);
bool decodeValue(const JsonNode& node, const Notes& notes, const Place& place, ProblemList& problems, int& out);
bool decodeValue(const JsonNode& node, const Notes& notes, const Place& place, ProblemList& problems, double& out);
bool decodeValue(const JsonNode& node, const Notes& notes, const Place& place, ProblemList& problems, std::string& out);
bool decodeValue(const JsonNode& node, const Notes& notes, const Place& place, ProblemList& problems,
                 std::variant<int, std::string>& out);

/// The index of the spelling that `node` holds.
std::optional<std::size_t> decodeSpelling(const JsonNode& node, std::span<const Spelling> spellings, const Place& place,
                                          ProblemList& problems);

void addWrongType(const JsonNode& node, std::string_view expected, const Place& place, ProblemList& problems);
void addUnknownKey(const std::vector<std::string_view>& known, const Place& place, ProblemList& problems);

template <Spelled Enum>
bool decodeValue(const JsonNode& node, const Notes&, const Place& place, ProblemList& problems, Enum& out) {
  const auto index = decodeSpelling(node, kSpellings<Enum>, place, problems);
  if (index) out = static_cast<Enum>(*index);
  return index.has_value();
}

template <Described T>
bool decodeValue(const JsonNode& node, const Notes& notes, const Place& place, ProblemList& problems, T& out);

template <class T>
bool decodeValue(const JsonNode& node, const Notes& notes, const Place& place, ProblemList& problems,
                 std::optional<T>& out) {
  T value{};
  const bool taken = decodeValue(node, notes, place, problems, value);
  if (taken) out = std::move(value);
  return taken;
}

template <class T, std::size_t kSize>
bool decodeValue(const JsonNode& node, const Notes& notes, const Place& place, ProblemList& problems,
                 std::array<T, kSize>& out) {
  const auto* array = std::get_if<JsonNode::Array>(&node.value);
  if (!array || array->size() != kSize) {
    addWrongType(node, "an array of " + std::to_string(kSize) + " numbers", place, problems);
    return false;
  }
  std::array<T, kSize> value{};
  bool taken = true;
  for (std::size_t i = 0; i < kSize; ++i) {
    taken &= decodeValue((*array)[i], notes, Place(place, i), problems, value[i]);
  }
  if (taken) out = value;
  return taken;
}

template <class T>
bool decodeValue(const JsonNode& node, const Notes& notes, const Place& place, ProblemList& problems,
                 std::vector<T>& out) {
  const auto* array = std::get_if<JsonNode::Array>(&node.value);
  if (!array) {
    addWrongType(node, "an array", place, problems);
    return false;
  }
  if (!checkCount(array->size(), notes, place, problems)) return false;
  std::vector<T> list(array->size());
  bool taken = true;
  for (std::size_t i = 0; i < list.size(); ++i) {
    taken &= decodeValue((*array)[i], notes, Place(place, i), problems, list[i]);
  }
  taken = taken && checkDistinct(list, notes, place, problems);
  if (taken) out = std::move(list);
  return taken;
}

template <class T>
inline constexpr bool kIsOptionalStruct = false;
template <Described T>
inline constexpr bool kIsOptionalStruct<std::optional<T>> = true;

/// Reads the member `key` of T's JSON object. False = T has none of that name.
template <Described T>
bool decodeMember(std::string_view key, const JsonNode& node, const Place& place, ProblemList& problems, T& out) {
  bool known = false;
  forEachField<T>([&]<class F>(const F& field) {
    if (known) return;
    if constexpr (kIsOptionalStruct<typename F::Member>) {
      if (field.inlined) {
        auto inner = (out.*field.member).value_or(typename F::Member::value_type{});
        known = decodeMember(key, node, place, problems, inner);
        if (known) out.*field.member = std::move(inner);
        return;
      }
    }
    if (field.name != key) return;
    known = true;
    decodeValue(node, field.notes, place, problems, out.*field.member);
  });
  return known;
}

/// Every key of T's JSON object, those of inlined structs included.
template <Described T>
void appendKeys(std::vector<std::string_view>& keys) {
  forEachField<T>([&]<class F>(const F& field) {
    if constexpr (kIsOptionalStruct<typename F::Member>) {
      if (field.inlined) return appendKeys<typename F::Member::value_type>(keys);
    }
    keys.push_back(field.name);
  });
}

template <Described T>
bool decodeValue(const JsonNode& node, const Notes&, const Place& place, ProblemList& problems, T& out) {
  const auto* object = std::get_if<JsonNode::Object>(&node.value);
  if (!object) {
    addWrongType(node, "an object", place, problems);
    return false;
  }
  for (const JsonMember& member : *object) {
    const Place inner(place, member.key);
    if (decodeMember(member.key, member.value, inner, problems, out)) continue;
    std::vector<std::string_view> known;
    appendKeys<T>(known);
    addUnknownKey(known, inner, problems);
  }
  return true;
}

} // namespace gnomon
