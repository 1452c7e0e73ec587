#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <string_view>
#include <tuple>
#include <type_traits>

/// How a struct describes its members, once. Decoding, encoding, range checks, the JSON schema and the field
/// tables are all computed from these descriptions (field_rows.h, reply_rows.h).
/// Members and enumerators are spelled in JSON as in C++. A member or an enumerator without its row does not compile.
namespace gnomon {

/// The numbers that a field takes; an open end is excluded. Applies to each component of a vector.
struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool minOpen = false;
  bool maxOpen = false;

  /// False for NaN.
  constexpr bool contains(double value) const {
    return (minOpen ? value > min : value >= min) && (maxOpen ? value < max : value <= max);
  }
};

/// The only numbers that an integer field takes, where a range would say too little.
struct Choices {
  std::array<int, 16> values{};
  std::size_t count = 0;

  constexpr bool contains(double value) const {
    for (std::size_t i = 0; i < count; ++i) {
      if (values[i] == value) return true;
    }
    return false;
  }
};

template <class... Values>
constexpr Choices choices(Values... values) {
  return {{values...}, sizeof...(values)};
}

constexpr Choices powersOfTwo(int first, int last) {
  Choices result;
  for (int value = first; value <= last; value *= 2) result.values[result.count++] = value;
  return result;
}

/// What the type of a member doesn't say.
struct Notes {
  std::string_view says{};    ///< one sentence: what it means, and what its absence means
  std::string_view unit = ""; ///< "" = a plain number, or no number
  Range range{};
  Choices choices{};        ///< none = every value of the range
  std::size_t minCount = 0; ///< elements of a list, bytes of a string
  std::size_t maxCount = std::numeric_limits<std::size_t>::max();
  bool distinct = false; ///< a list's elements all differ
  bool onlyTrue = false; ///< a switch that may be left out, but not be false
  bool isTime = false;   ///< a text that readMoment (moment.h) reads: between keys of a sequence time passes evenly
};

template <class Owner, class MemberType>
struct Field {
  using Member = MemberType;
  std::string_view name; ///< the JSON key and the member's name
  Member Owner::*member;
  Notes notes;
  bool inlined = false; ///< an optional struct whose own fields are directly in the owner's JSON object
};

/// The enumerator's or the member's name as the compiler writes it; a number in parentheses where there is none.
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

template <class Owner, class Member>
constexpr Field<Owner, Member> fieldOf(std::string_view name, Member Owner::*member, std::string_view says, Notes notes,
                                       bool inlined) {
  notes.says = says;
  return {name, member, notes, inlined};
}

/// The row of a member: field<&Camera::node>("What it means.").
template <auto kMember>
constexpr auto field(std::string_view says, Notes notes = {}) {
  return fieldOf(compilerName<kMember>(), kMember, says, notes, false);
}

template <auto kMember>
constexpr auto inlined(std::string_view says, Notes notes = {}) {
  return fieldOf(compilerName<kMember>(), kMember, says, notes, true);
}

/// Optional fields of which at most one may be given; unused places are empty.
using Alternatives = std::array<std::string_view, 5>;

template <class Owner, class... Members>
struct Rows {
  std::string_view name; ///< the schema's name
  std::string_view says; ///< one sentence
  std::tuple<Field<Owner, Members>...> fields;
  std::array<Alternatives, 2> alternatives{};
  bool reply = false; ///< only ever written by the server: what is not optional is always there

  constexpr Rows withAlternatives(Alternatives first, Alternatives second = {}) const {
    return {name, says, fields, {first, second}, reply};
  }
};

/// Stands for any member when an aggregate is initialised in an unevaluated place.
struct AnyMember {
  template <class T>
  operator T() const;
};

/// How many members the aggregate T has: the most initialisers that it takes.
template <class T, class... Initialisers>
consteval std::size_t memberCount() {
  if constexpr (requires { T{Initialisers{}..., AnyMember{}}; }) {
    return memberCount<T, Initialisers..., AnyMember>();
  } else {
    return sizeof...(Initialisers);
  }
}

template <class Owner, class... Members>
constexpr Rows<Owner, Members...> rows(std::string_view name, std::string_view says, Field<Owner, Members>... fields) {
  static_assert(sizeof...(Members) == memberCount<Owner>(), "a member has no row");
  return {name, says, {fields...}, {}, false};
}

template <class Owner, class... Members>
constexpr Rows<Owner, Members...> replyRows(std::string_view name, std::string_view says,
                                            Field<Owner, Members>... fields) {
  Rows<Owner, Members...> result = rows(name, says, fields...);
  result.reply = true;
  return result;
}

/// A described struct has a specialisation of this.
template <class T>
inline constexpr std::nullptr_t kRows = nullptr;

template <class T>
concept Described = !std::is_same_v<std::remove_cv_t<decltype(kRows<T>)>, std::nullptr_t>;

template <Described T>
inline constexpr std::size_t kRowCount = std::tuple_size_v<decltype(kRows<T>.fields)>;

/// Calls `visit` with every field of T in order.
template <Described T, class Visit>
constexpr void forEachField(Visit&& visit) {
  std::apply([&](const auto&... fields) { (visit(fields), ...); }, kRows<T>.fields);
}

struct Spelling {
  int value = 0;
  std::string_view name;
  std::string_view says; ///< a phrase for the documentation; empty = the name says it
};

/// The row of an enumerator: spelling<View::depth>("a phrase").
template <auto kEnumerator>
constexpr Spelling spelling(std::string_view says = "") {
  return {static_cast<int>(kEnumerator), compilerName<kEnumerator>(), says};
}

/// A spelled enum has a specialisation of this: one element for each enumerator, in order.
template <class Enum>
inline constexpr std::array<Spelling, 0> kSpellings{};

template <class T>
concept Spelled = !kSpellings<T>.empty();

/// A JSON word of earlier versions, which is refused with the name of the one that took its place.
struct RetiredWord {
  std::string_view name, successor;
};

template <class Enum>
inline constexpr std::array<RetiredWord, 0> kRetiredWords{};

template <auto kValue>
consteval bool isEnumerator() {
  return !compilerName<kValue>().starts_with('(');
}

/// True where the table holds every enumerator of Enum, in order from 0.
template <class Enum>
consteval bool spellsAll() {
  for (std::size_t i = 0; i < kSpellings<Enum>.size(); ++i) {
    if (kSpellings<Enum>[i].value != static_cast<int>(i)) return false;
  }
  return !isEnumerator<static_cast<Enum>(kSpellings<Enum>.size())>();
}

/// True where a table has one row for each enumerator, in order. `key`: the row's enumerator.
template <class Row, std::size_t kCount, Spelled Enum>
consteval bool rowsAreComplete(const std::array<Row, kCount>& rows, Enum Row::*key) {
  static_assert(spellsAll<Enum>());
  for (std::size_t i = 0; i < kCount; ++i) {
    if (static_cast<std::size_t>(rows[i].*key) != i) return false;
  }
  return kCount == kSpellings<Enum>.size();
}

/// The JSON word of an enumerator.
template <Spelled Enum>
constexpr std::string_view spell(Enum value) {
  static_assert(spellsAll<Enum>());
  return kSpellings<Enum>[static_cast<std::size_t>(value)].name;
}

} // namespace gnomon
