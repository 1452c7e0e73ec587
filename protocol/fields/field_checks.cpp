#include "protocol/fields/field_checks.h"

#include <cassert>
#include <charconv>
#include <cmath>

#include "protocol/base/text.h"

namespace gnomon {
namespace {

bool add(ProblemList& problems, const Place& place, std::string detail, std::string limit, std::string actual) {
  problems.add(invalidValue(place.pointer(), std::move(detail), std::move(limit), std::move(actual)));
  return false;
}

std::string countText(const Notes& notes) {
  const bool bounded = notes.maxCount != Notes{}.maxCount;
  if (!bounded) return "at least " + std::to_string(notes.minCount);
  if (notes.minCount == 0) return "at most " + std::to_string(notes.maxCount);
  return std::to_string(notes.minCount) + ".." + std::to_string(notes.maxCount);
}

bool checkEnumerator(int value, std::size_t count, const Place& place, ProblemList& problems) {
  if (value >= 0 && static_cast<std::size_t>(value) < count) return true;
  return add(problems, place, "This is not one of the possible values.", "", std::to_string(value));
}

void checkElements(const ValueType& type, const void* container, const Notes& notes, const Place& place,
                   ProblemList& problems) {
  for (std::size_t i = 0; i < type.size(container); ++i) {
    checkAll(*type.element, type.at(container, i), notes, Place(place, i), problems);
  }
}

} // namespace

std::string numberText(double value) {
  constexpr double kPlainLimit = 1e15;
  const bool plain = std::abs(value) < kPlainLimit && value == std::trunc(value);
  std::array<char, 64> buffer{};
  const auto end =
      plain ? std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed).ptr
            : std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  return {buffer.data(), end};
}

std::string rangeText(const Notes& notes) {
  if (notes.choices.count > 0) {
    std::string text;
    for (std::size_t i = 0; i < notes.choices.count; ++i) {
      if (i > 0) text += i + 1 == notes.choices.count ? " or " : ", ";
      text += std::to_string(notes.choices.values[i]);
    }
    return text;
  }
  const Range& range = notes.range;
  const bool hasMin = std::isfinite(range.min);
  const bool hasMax = std::isfinite(range.max);
  if (hasMin && hasMax && !range.minOpen && !range.maxOpen) {
    return numberText(range.min) + ".." + numberText(range.max);
  }
  std::string text;
  if (hasMin) text += (range.minOpen ? "more than " : "at least ") + numberText(range.min);
  if (hasMin && hasMax) text += " and ";
  if (hasMax) text += (range.maxOpen ? "less than " : "at most ") + numberText(range.max);
  return text;
}

bool checkNumber(double value, const Notes& notes, const Place& place, ProblemList& problems) {
  if (!std::isfinite(value)) {
    return add(problems, place, "This is not a finite number.", rangeText(notes), numberText(value));
  }
  if (notes.choices.count > 0 ? notes.choices.contains(value) : notes.range.contains(value)) return true;
  const std::string detail =
      notes.choices.count > 0 ? "This is not one of the possible values." : "This is out of range.";
  return add(problems, place, detail, rangeText(notes), numberText(value));
}

bool checkSwitch(bool value, const Notes& notes, const Place& place, ProblemList& problems) {
  if (value || !notes.onlyTrue) return true;
  return add(problems, place, "This may be left out, but it can't be false.", "true", "false");
}

bool checkText(std::string_view text, const Notes& notes, const Place& place, ProblemList& problems) {
  if (text.size() < notes.minCount || text.size() > notes.maxCount) {
    return add(problems, place, text.empty() ? "This text is empty." : "This text is too long.",
               countText(notes) + " bytes", std::to_string(text.size()) + " bytes");
  }
  if (isUtf8(text)) return true;
  return add(problems, place, "This text is not UTF-8.", "UTF-8", "");
}

bool checkCount(std::size_t count, const Notes& notes, const Place& place, ProblemList& problems) {
  if (count >= notes.minCount && count <= notes.maxCount) return true;
  return add(problems, place, count < notes.minCount ? "This list is too short." : "This list is too long.",
             countText(notes) + " elements", std::to_string(count));
}

bool checkDistinct(const ValueType& type, const void* list, const Notes& notes, const Place& place,
                   ProblemList& problems) {
  if (!notes.distinct) return true;
  assert(type.equal);
  bool good = true;
  for (std::size_t i = 0; i < type.size(list); ++i) {
    bool isFirst = true;
    for (std::size_t j = 0; j < i && isFirst; ++j) isFirst = !type.equal(type.at(list, j), type.at(list, i));
    if (isFirst) continue;
    problems.add(invalidValue(Place(place, i).pointer(), "This value appears more than once in its list."));
    good = false;
  }
  return good;
}

void checkAll(const ValueType& type, const void* value, const Notes& notes, const Place& place, ProblemList& problems) {
  using Kind = ValueType::Kind;
  switch (type.kind) {
    case Kind::boolean:
      checkSwitch(valueAs<bool>(value), notes, place, problems);
      return;
    case Kind::integer:
      checkNumber(valueAs<int>(value), notes, place, problems);
      return;
    case Kind::number:
      checkNumber(valueAs<double>(value), notes, place, problems);
      return;
    case Kind::text:
      checkText(valueAs<std::string>(value), notes, place, problems);
      return;
    case Kind::indexOrName: {
      const auto& either = valueAs<std::variant<int, std::string>>(value);
      if (const int* index = std::get_if<int>(&either)) {
        checkNumber(*index, notes, place, problems);
      } else {
        checkText(std::get<std::string>(either), notes, place, problems);
      }
      return;
    }
    case Kind::word:
      checkEnumerator(type.wordIndex(value), type.spellings.size(), place, problems);
      return;
    case Kind::optional:
      if (type.size(value) > 0) checkAll(*type.element, type.at(value, 0), notes, place, problems);
      return;
    case Kind::array:
      checkElements(type, value, notes, place, problems);
      return;
    case Kind::list:
      if (!checkCount(type.size(value), notes, place, problems)) return;
      checkElements(type, value, notes, place, problems);
      checkDistinct(type, value, notes, place, problems);
      return;
    case Kind::object:
      for (const FieldType& field : type.object->fields) {
        const Place inner = field.inlined ? place : Place(place, field.name);
        checkAll(*field.type, field.member(value), *field.notes, inner, problems);
      }
      return;
    case Kind::integer64: // what only replies hold has no bounds
    case Kind::unsigned64:
    case Kind::custom:
      return;
  }
}

} // namespace gnomon
