#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <concepts>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "protocol/base/json_pointer.h"
#include "protocol/base/problem_list.h"
#include "protocol/fields/fields.h"
#include "protocol/fields/spellings.h"

/// Holds values against the bounds in their rows. Each check adds its problem and tells whether there was none.
namespace gnomon {

/// "720", "0.1": the shortest text that reads back as the same number.
std::string numberText(double value);

/// What a number may be, for people: "1..8192", "more than 0 and less than 180", "3, 5 or 7".
std::string rangeText(const Notes& notes);

bool checkNumber(double value, const Notes& notes, const Place& place, ProblemList& problems);
bool checkSwitch(bool value, const Notes& notes, const Place& place, ProblemList& problems);
bool checkText(std::string_view text, const Notes& notes, const Place& place, ProblemList& problems);
bool checkCount(std::size_t count, const Notes& notes, const Place& place, ProblemList& problems);
bool checkEnumerator(int value, std::size_t count, const Place& place, ProblemList& problems);

/// No two elements are the same, where the row asks for that.
template <class T>
bool checkDistinct(const std::vector<T>& list, const Notes& notes, const Place& place, ProblemList& problems) {
  bool good = true;
  if constexpr (std::equality_comparable<T>) {
    for (std::size_t i = 0; notes.distinct && i < list.size(); ++i) {
      if (std::find(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(i), list[i]) ==
          list.begin() + static_cast<std::ptrdiff_t>(i)) {
        continue;
      }
      problems.add({.code = ProblemCode::invalidValue,
                    .pointer = Place(place, i).pointer(),
                    .detail = "This stands in its list more than once."});
      good = false;
    }
  } else {
    assert(!notes.distinct); // what replies hold, of which no list need be distinct
  }
  return good;
}

/// Checks a value and everything in it.
inline void checkAll(bool value, const Notes& notes, const Place& place, ProblemList& problems) {
  checkSwitch(value, notes, place, problems);
}
inline void checkAll(int value, const Notes& notes, const Place& place, ProblemList& problems) {
  checkNumber(value, notes, place, problems);
}
inline void checkAll(double value, const Notes& notes, const Place& place, ProblemList& problems) {
  checkNumber(value, notes, place, problems);
}
inline void checkAll(const std::string& value, const Notes& notes, const Place& place, ProblemList& problems) {
  checkText(value, notes, place, problems);
}

template <Spelled Enum>
void checkAll(Enum value, const Notes&, const Place& place, ProblemList& problems) {
  checkEnumerator(static_cast<int>(value), kSpellings<Enum>.size(), place, problems);
}

template <Described T>
void checkAll(const T& value, const Notes&, const Place& place, ProblemList& problems);

template <class T>
void checkAll(const std::optional<T>& value, const Notes& notes, const Place& place, ProblemList& problems) {
  if (value) checkAll(*value, notes, place, problems);
}

template <class... Kinds>
void checkAll(const std::variant<Kinds...>& value, const Notes& notes, const Place& place, ProblemList& problems) {
  std::visit([&](const auto& held) { checkAll(held, notes, place, problems); }, value);
}

template <class T, std::size_t kSize>
void checkAll(const std::array<T, kSize>& value, const Notes& notes, const Place& place, ProblemList& problems) {
  for (std::size_t i = 0; i < kSize; ++i) checkAll(value[i], notes, Place(place, i), problems);
}

template <class T>
void checkAll(const std::vector<T>& list, const Notes& notes, const Place& place, ProblemList& problems) {
  if (!checkCount(list.size(), notes, place, problems)) return;
  for (std::size_t i = 0; i < list.size(); ++i) checkAll(list[i], notes, Place(place, i), problems);
  checkDistinct(list, notes, place, problems);
}

template <Described T>
void checkAll(const T& value, const Notes&, const Place& place, ProblemList& problems) {
  forEachField<T>([&](const auto& field) {
    const Place inner = field.inlined ? place : Place(place, field.name);
    checkAll(value.*field.member, field.notes, inner, problems);
  });
}

} // namespace gnomon
