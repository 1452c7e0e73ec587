#include "protocol/fields/field_decode.h"

#include <cmath>
#include <limits>

namespace gnomon {
namespace {

/// The number as double; nothing where the node is no number.
std::optional<double> numberOf(const JsonNode& node) {
  if (const auto* value = std::get_if<std::int64_t>(&node.value)) return static_cast<double>(*value);
  if (const auto* value = std::get_if<std::uint64_t>(&node.value)) return static_cast<double>(*value);
  if (const auto* real = std::get_if<JsonReal>(&node.value)) return real->value;
  return std::nullopt;
}

} // namespace

void addWrongType(const JsonNode& node, std::string_view expected, const Place& place, ProblemList& problems) {
  const bool isNull = std::holds_alternative<std::nullptr_t>(node.value);
  problems.add({.code = ProblemCode::invalidValue,
                .pointer = place.pointer(),
                .detail = isNull ? "null is no value here; to leave a field out, leave out its key."
                                 : "This is not " + std::string(expected) + ".",
                .limit = std::string(expected),
                .actual = shownNode(node)});
}

void addUnknownKey(const std::vector<std::string_view>& known, const Place& place, ProblemList& problems) {
  std::string names;
  for (const std::string_view name : known) {
    if (!names.empty()) names += ", ";
    names += name;
  }
  problems.add({.code = ProblemCode::invalidValue,
                .pointer = place.pointer(),
                .detail = "There is no field of this name.",
                .limit = names});
}

bool decodeValue(const JsonNode& node, const Notes& notes, const Place& place, ProblemList& problems, bool& out) {
  const auto* value = std::get_if<bool>(&node.value);
  if (!value) {
    addWrongType(node, "true or false", place, problems);
    return false;
  }
  if (!checkSwitch(*value, notes, place, problems)) return false;
  out = *value;
  return true;
}

bool decodeValue(const JsonNode& node, const Notes& notes, const Place& place, ProblemList& problems, int& out) {
  const std::optional<double> value = numberOf(node);
  if (!value || *value != std::trunc(*value)) {
    addWrongType(node, "a whole number", place, problems);
    return false;
  }
  if (!checkNumber(*value, notes, place, problems)) return false;
  constexpr double kMost =
      std::numeric_limits<int>::max(); // rows of requests have narrower ranges; those of replies none
  if (std::abs(*value) > kMost) {
    addWrongType(node, "a whole number of 32 bits", place, problems);
    return false;
  }
  out = static_cast<int>(*value);
  return true;
}

bool decodeValue(const JsonNode& node, const Notes& notes, const Place& place, ProblemList& problems, double& out) {
  const std::optional<double> value = numberOf(node);
  if (!value) {
    addWrongType(node, "a number", place, problems);
    return false;
  }
  if (!checkNumber(*value, notes, place, problems)) return false;
  out = *value;
  return true;
}

bool decodeValue(const JsonNode& node, const Notes& notes, const Place& place, ProblemList& problems,
                 std::string& out) {
  const auto* text = std::get_if<std::string>(&node.value);
  if (!text) {
    addWrongType(node, "a string", place, problems);
    return false;
  }
  if (!checkText(*text, notes, place, problems)) return false;
  out = *text;
  return true;
}

bool decodeValue(const JsonNode& node, const Notes& notes, const Place& place, ProblemList& problems,
                 std::variant<int, std::string>& out) {
  const auto take = [&](auto value) {
    const bool taken = decodeValue(node, notes, place, problems, value);
    if (taken) out = std::move(value);
    return taken;
  };
  if (std::holds_alternative<std::string>(node.value)) return take(std::string());
  if (numberOf(node)) return take(0);
  addWrongType(node, "a whole number or a string", place, problems);
  return false;
}

std::optional<std::size_t> decodeSpelling(const JsonNode& node, std::span<const Spelling> spellings, const Place& place,
                                          ProblemList& problems) {
  const auto* text = std::get_if<std::string>(&node.value);
  std::string names;
  for (std::size_t i = 0; i < spellings.size(); ++i) {
    if (text && *text == spellings[i].name) return i;
    if (i > 0) names += i + 1 == spellings.size() ? " or " : ", ";
    names += spellings[i].name;
  }
  if (!text) {
    addWrongType(node, names, place, problems);
  } else {
    problems.add({.code = ProblemCode::invalidValue,
                  .pointer = place.pointer(),
                  .detail = "This is not one of the possible values.",
                  .limit = names,
                  .actual = shownNode(node)});
  }
  return std::nullopt;
}

} // namespace gnomon
