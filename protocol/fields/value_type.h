#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string_view>

#include "protocol/base/json.h"
#include "protocol/base/result.h"
#include "protocol/fields/fields.h"
#include "protocol/json/json_source.h"

/// What the compiler knows of a member's type, as a table. So what reads, writes, checks and describes fields are plain
/// functions, compiled once, and not templates over every struct.
namespace gnomon {

struct ValueType;

/// A field of a described struct.
struct FieldType {
  std::string_view name;
  const Notes* notes;
  bool inlined;
  const ValueType* type;
  const void* (*member)(const void* owner);
};

/// A described struct.
struct StructType {
  std::string_view name;
  std::string_view says;
  std::span<const FieldType> fields;
  std::array<Alternatives, 2> alternatives;
  bool reply;
  const void* (*initial)(); ///< a value whose members are all as initialised
};

/// A type with a form of its own in JSON has a specialisation of kCustomType.
struct CustomType {
  bool (*decode)(const JsonNode& node, const Place& place, ProblemList& problems, void* out);
  Json (*encode)(const void* value);
  Json (*schema)();
};

struct ValueType {
  enum class Kind {
    boolean,
    integer,     ///< int
    integer64,   ///< std::int64_t
    unsigned64,  ///< std::uint64_t
    number,      ///< double
    text,        ///< std::string
    indexOrName, ///< std::variant<int, std::string>
    word,        ///< an enum
    optional,
    array, ///< of a fixed size
    list,  ///< std::vector
    object,
    custom
  };
  Kind kind;

  std::span<const Spelling> spellings{};  ///< of a word
  std::span<const RetiredWord> retired{}; ///< words of earlier versions
  int (*wordIndex)(const void* word) = nullptr;
  void (*setWord)(void* word, int index) = nullptr;

  const StructType* object = nullptr;
  const CustomType* custom = nullptr;

  // Of an optional, an array and a list; an absent optional has no element, another has one.
  const ValueType* element = nullptr;
  std::size_t arraySize = 0;
  std::size_t (*size)(const void* container) = nullptr;
  const void* (*at)(const void* container, std::size_t index) = nullptr;
  bool (*equal)(const void* element, const void* other) = nullptr; ///< null = elements can't be compared

  /// Makes a container of `count` elements, lets `fill` write them, and moves it to `out` if that gives true. Gives
  /// back what `fill` gave.
  bool (*make)(void* out, std::size_t count, const std::function<bool(void* container)>& fill) = nullptr;
  void* (*orMake)(void* optional) = nullptr; ///< its element, made where it is absent
};

template <class T>
inline constexpr std::nullptr_t kCustomType = nullptr;

template <class T>
concept Custom = std::same_as<const CustomType, decltype(kCustomType<T>)>;

/// What a pointer to a value of a known type points to.
template <class T>
const T& valueAs(const void* value) {
  return *static_cast<const T*>(value);
}
template <class T>
T& valueAs(void* value) {
  return *static_cast<T*>(value);
}

/// The type T as a table. described_types.cpp has those of all structs that are read or written as a whole.
template <class T>
const ValueType& typeOf();

} // namespace gnomon
