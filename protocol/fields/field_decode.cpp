#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "protocol/base/text.h"
#include "protocol/fields/field_checks.h"
#include "protocol/fields/field_codec.h"

namespace gnomon {
namespace {

/// The number as double; nothing where the node is no number.
std::optional<double> numberOf(const JsonNode& node) {
  if (const auto* value = std::get_if<std::int64_t>(&node.value)) return static_cast<double>(*value);
  if (const auto* value = std::get_if<std::uint64_t>(&node.value)) return static_cast<double>(*value);
  if (const auto* real = std::get_if<JsonReal>(&node.value)) return real->value;
  return std::nullopt;
}

void addUnknownKey(std::string_view key, const std::vector<std::string_view>& known, const Place& place,
                   ProblemList& problems) {
  std::string names;
  for (const std::string_view name : known) {
    if (!names.empty()) names += ", ";
    names += name;
  }
  const std::vector<std::string> words(known.begin(), known.end());
  problems.add(invalidValue(place.pointer(), "There is no field of this name" + suggestion(key, words), names));
}

bool decode(const JsonNode& node, const Notes& notes, const Place& place, ProblemList& problems, bool& out) {
  const auto* value = std::get_if<bool>(&node.value);
  if (!value) return addWrongType(node, "true or false", place, problems);
  if (!checkSwitch(*value, notes, place, problems)) return false;
  out = *value;
  return true;
}

bool decode(const JsonNode& node, const Notes& notes, const Place& place, ProblemList& problems, int& out) {
  const std::optional<double> value = numberOf(node);
  if (!value || *value != std::trunc(*value)) return addWrongType(node, "a whole number", place, problems);
  if (!checkNumber(*value, notes, place, problems)) return false;
  constexpr double kMost =
      std::numeric_limits<int>::max(); // rows of requests have narrower ranges; those of replies none
  if (std::abs(*value) > kMost) return addWrongType(node, "a whole number of 32 bits", place, problems);
  out = static_cast<int>(*value);
  return true;
}

bool decode(const JsonNode& node, const Place& place, ProblemList& problems, std::uint64_t& out) {
  const auto* value = std::get_if<std::uint64_t>(&node.value);
  if (!value) return addWrongType(node, "a whole number of at least 0", place, problems);
  out = *value;
  return true;
}

bool decode(const JsonNode& node, const Place& place, ProblemList& problems, std::int64_t& out) {
  const auto* positive = std::get_if<std::uint64_t>(&node.value);
  const auto* negative = std::get_if<std::int64_t>(&node.value);
  const bool fits = negative || (positive && *positive <= std::uint64_t{std::numeric_limits<std::int64_t>::max()});
  if (!fits) return addWrongType(node, "a whole number of 64 bits", place, problems);
  out = negative ? *negative : static_cast<std::int64_t>(*positive);
  return true;
}

bool decode(const JsonNode& node, const Notes& notes, const Place& place, ProblemList& problems, double& out) {
  const std::optional<double> value = numberOf(node);
  if (!value) return addWrongType(node, "a number", place, problems);
  if (!checkNumber(*value, notes, place, problems)) return false;
  out = *value;
  return true;
}

bool decode(const JsonNode& node, const Notes& notes, const Place& place, ProblemList& problems, std::string& out) {
  const auto* text = std::get_if<std::string>(&node.value);
  if (!text) return addWrongType(node, "a string", place, problems);
  if (!checkText(*text, notes, place, problems)) return false;
  out = *text;
  return true;
}

bool decode(const JsonNode& node, const Notes& notes, const Place& place, ProblemList& problems,
            std::variant<int, std::string>& out) {
  const auto take = [&](auto value) {
    const bool taken = decode(node, notes, place, problems, value);
    if (taken) out = std::move(value);
    return taken;
  };
  if (std::holds_alternative<std::string>(node.value)) return take(std::string());
  if (numberOf(node)) return take(0);
  return addWrongType(node, "a whole number or a string", place, problems);
}

/// Why a word is none of a type's.
std::string notAWord(const std::string& text, const ValueType& type) {
  const auto retired = std::ranges::find(type.retired, text, &RetiredWord::name);
  if (retired != type.retired.end()) {
    return "Earlier versions had this value. Its successor is " + std::string(retired->successor) + ".";
  }
  std::vector<std::string> words;
  for (const Spelling& spelling : type.spellings) words.emplace_back(spelling.name);
  return "This is not one of the possible values" + suggestion(text, words);
}

bool decodeWord(const JsonNode& node, const Place& place, ProblemList& problems, const ValueType& type, void* out) {
  const auto* text = std::get_if<std::string>(&node.value);
  std::string names;
  for (std::size_t i = 0; i < type.spellings.size(); ++i) {
    const std::string_view name = type.spellings[i].name;
    if (text && *text == name) {
      type.setWord(out, static_cast<int>(i));
      return true;
    }
    if (i > 0) names += i + 1 == type.spellings.size() ? " or " : ", ";
    names += name;
  }
  if (!text) {
    addWrongType(node, names, place, problems);
  } else {
    problems.add(invalidValue(place.pointer(), notAWord(*text, type), names, shownNode(node)));
  }
  return false;
}

/// A place within a container that is being filled.
void* elementOf(const ValueType& type, void* container, std::size_t index) {
  return const_cast<void*>(type.at(container, index));
}

bool decodeElements(const JsonNode::Array& array, const Notes& notes, const Place& place, ProblemList& problems,
                    const ValueType& type, void* container) {
  bool taken = true;
  for (std::size_t i = 0; i < array.size(); ++i) {
    taken &= decodeValue(array[i], notes, Place(place, i), problems, *type.element, elementOf(type, container, i));
  }
  return taken;
}

bool decodeArray(const JsonNode& node, const Notes& notes, const Place& place, ProblemList& problems,
                 const ValueType& type, void* out) {
  const auto* array = std::get_if<JsonNode::Array>(&node.value);
  if (!array || array->size() != type.arraySize)
    return addWrongType(node, "an array of " + std::to_string(type.arraySize) + " numbers", place, problems);
  return type.make(out, array->size(),
                   [&](void* container) { return decodeElements(*array, notes, place, problems, type, container); });
}

bool decodeList(const JsonNode& node, const Notes& notes, const Place& place, ProblemList& problems,
                const ValueType& type, void* out) {
  const auto* array = std::get_if<JsonNode::Array>(&node.value);
  if (!array) return addWrongType(node, "an array", place, problems);
  if (!checkCount(array->size(), notes, place, problems)) return false;
  return type.make(out, array->size(), [&](void* list) {
    return decodeElements(*array, notes, place, problems, type, list) &&
           checkDistinct(type, list, notes, place, problems);
  });
}

bool hasKey(const StructType& type, std::string_view key) {
  std::vector<std::string_view> keys;
  appendKeys(type, keys);
  return std::find(keys.begin(), keys.end(), key) != keys.end();
}

/// Reads the member `key` of a struct's JSON object. False = the struct has none of that name.
bool decodeMember(std::string_view key, const JsonNode& node, const Place& place, ProblemList& problems,
                  const StructType& type, void* owner) {
  for (const FieldType& field : type.fields) {
    void* member = const_cast<void*>(field.member(owner));
    if (field.inlined) {
      const StructType& inner = *field.type->element->object;
      if (hasKey(inner, key)) return decodeMember(key, node, place, problems, inner, field.type->orMake(member));
    } else if (field.name == key) {
      decodeValue(node, *field.notes, place, problems, *field.type, member);
      return true;
    }
  }
  return false;
}

bool decodeObject(const JsonNode& node, const Place& place, ProblemList& problems, const StructType& type, void* out) {
  const auto* object = std::get_if<JsonNode::Object>(&node.value);
  if (!object) return addWrongType(node, "an object", place, problems);
  for (const JsonMember& member : *object) {
    const Place inner(place, member.key);
    if (decodeMember(member.key, member.value, inner, problems, type, out)) continue;
    std::vector<std::string_view> known;
    appendKeys(type, known);
    addUnknownKey(member.key, known, inner, problems);
  }
  return true;
}

} // namespace

bool addWrongType(const JsonNode& node, std::string_view expected, const Place& place, ProblemList& problems) {
  const bool isNull = std::holds_alternative<std::nullptr_t>(node.value);
  problems.add(invalidValue(place.pointer(),
                            isNull ? "null is no value here; to leave a field out, leave out its key."
                                   : "This is not " + std::string(expected) + ".",
                            std::string(expected), shownNode(node)));
  return false;
}

void appendKeys(const StructType& type, std::vector<std::string_view>& keys) {
  for (const FieldType& field : type.fields) {
    if (field.inlined) {
      appendKeys(*field.type->element->object, keys);
    } else {
      keys.push_back(field.name);
    }
  }
}

Problems decodeJson(std::string_view json, const ValueType& type, void* out) {
  ProblemList problems;
  const std::optional<JsonNode> root = readJson(json, problems);
  if (root) decodeValue(*root, Notes{}, Place(), problems, type, out);
  return std::move(problems).take();
}

bool readReply(std::string_view json, std::initializer_list<const char*> keys, const ValueType& type, void* out) {
  const Json document = Json::parse(json, nullptr, false);
  const auto isThere = [&](const char* key) { return document.is_object() && document.contains(key); };
  if (!std::all_of(keys.begin(), keys.end(), isThere)) return false;
  ProblemList unknown;
  decodeValue(nodeOf(document), Notes{}, Place(), unknown, type, out);
  return true;
}

bool decodeValue(const JsonNode& node, const Notes& notes, const Place& place, ProblemList& problems,
                 const ValueType& type, void* out) {
  using Kind = ValueType::Kind;
  switch (type.kind) {
    case Kind::boolean:
      return decode(node, notes, place, problems, valueAs<bool>(out));
    case Kind::integer:
      return decode(node, notes, place, problems, valueAs<int>(out));
    case Kind::integer64:
      return decode(node, place, problems, valueAs<std::int64_t>(out));
    case Kind::unsigned64:
      return decode(node, place, problems, valueAs<std::uint64_t>(out));
    case Kind::number:
      return decode(node, notes, place, problems, valueAs<double>(out));
    case Kind::text:
      return decode(node, notes, place, problems, valueAs<std::string>(out));
    case Kind::indexOrName:
      return decode(node, notes, place, problems, valueAs<std::variant<int, std::string>>(out));
    case Kind::word:
      return decodeWord(node, place, problems, type, out);
    case Kind::optional:
      return type.make(out, 1, [&](void* optional) {
        return decodeValue(node, notes, place, problems, *type.element, elementOf(type, optional, 0));
      });
    case Kind::array:
      return decodeArray(node, notes, place, problems, type, out);
    case Kind::list:
      return decodeList(node, notes, place, problems, type, out);
    case Kind::object:
      return decodeObject(node, place, problems, *type.object, out);
    case Kind::custom:
      return type.custom->decode(node, place, problems, out);
  }
  return false;
}

} // namespace gnomon
