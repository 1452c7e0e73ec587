#pragma once

#include <array>
#include <cstddef>
#include <string_view>

/// How the enumerators are spelled in JSON: as in C++, which the compiler checks.
namespace gnomon {

struct Spelling {
  int value = 0;
  std::string_view name;
  std::string_view says; ///< a phrase for the documentation; empty = the name says it
};

template <class Enum>
constexpr Spelling spelling(Enum value, std::string_view name, std::string_view says = "") {
  return {static_cast<int>(value), name, says};
}

/// A spelled enum has a specialisation of this: one element for each enumerator, in order.
template <class Enum>
inline constexpr std::array<Spelling, 0> kSpellings{};

template <class T>
concept Spelled = !kSpellings<T>.empty();

/// The enumerator's name as the compiler writes it; a number in parentheses where there is none.
template <auto kValue>
consteval std::string_view compilerName() {
  const std::string_view text = __PRETTY_FUNCTION__;
  const std::string_view marker = "kValue = ";
  const std::size_t begin = text.find(marker) + marker.size();
  const std::string_view value = text.substr(begin, text.find_first_of(";]", begin) - begin);
  if (value.starts_with('(')) return value;
  const std::string_view name = value.substr(value.rfind(':') + 1);
  return name.ends_with('_') ? name.substr(0, name.size() - 1) : name; // float_ avoids a keyword
}

/// True where the table holds every enumerator of Enum by its own name, in order from 0.
template <class Enum, std::size_t kIndex = 0>
consteval bool spellsAll() {
  constexpr std::string_view kName = compilerName<static_cast<Enum>(kIndex)>();
  if constexpr (kIndex == kSpellings<Enum>.size()) {
    return kName.starts_with('(');
  } else {
    constexpr Spelling kRow = kSpellings<Enum>[kIndex];
    return kRow.value == static_cast<int>(kIndex) && kRow.name == kName && spellsAll<Enum, kIndex + 1>();
  }
}

/// True where a table has one row for each enumerator, in order. `key`: the row's enumerator.
template <class Row, std::size_t kCount, Spelled Enum>
consteval bool rowsAreComplete(const std::array<Row, kCount>& rows, Enum Row::*key) {
  for (std::size_t i = 0; i < kCount; ++i) {
    if (static_cast<std::size_t>(rows[i].*key) != i) return false;
  }
  return kCount == kSpellings<Enum>.size();
}

/// The JSON word of an enumerator.
template <Spelled Enum>
constexpr std::string_view spell(Enum value) {
  return kSpellings<Enum>[static_cast<std::size_t>(value)].name;
}

} // namespace gnomon
