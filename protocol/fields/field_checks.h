#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "protocol/fields/value_type.h"

/// Checks of values against the bounds in their rows. Each adds its problem and returns whether there was none.
namespace gnomon {

/// "720", "0.1": the shortest text that reads back as the same number.
std::string numberText(double value);

/// What a number may be, for people: "1..8192", "more than 0 and less than 180", "3, 5 or 7".
std::string rangeText(const Notes& notes);

bool checkNumber(double value, const Notes& notes, const Place& place, ProblemList& problems);
bool checkSwitch(bool value, const Notes& notes, const Place& place, ProblemList& problems);
bool checkText(std::string_view text, const Notes& notes, const Place& place, ProblemList& problems);
bool checkCount(std::size_t count, const Notes& notes, const Place& place, ProblemList& problems);

/// No two elements are the same, where the row asks for that.
bool checkDistinct(const ValueType& type, const void* list, const Notes& notes, const Place& place,
                   ProblemList& problems);

/// Checks a value and everything in it.
void checkAll(const ValueType& type, const void* value, const Notes& notes, const Place& place, ProblemList& problems);

template <class T>
void checkAll(const T& value, const Notes& notes, const Place& place, ProblemList& problems) {
  checkAll(typeOf<T>(), &value, notes, place, problems);
}

} // namespace gnomon
