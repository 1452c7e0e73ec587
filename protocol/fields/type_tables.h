#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "protocol/fields/value_type.h"

/// Makes the table of a type, at compile time. Costs seconds for the larger structs, so that only described_types.cpp
/// and tests include this.
namespace gnomon {

template <class T>
consteval ValueType makeValueType();

template <class T>
inline constexpr ValueType kValueType = makeValueType<T>();

template <Described T, std::size_t kIndex>
const void* memberAt(const void* owner) {
  return &(static_cast<const T*>(owner)->*std::get<kIndex>(kRows<T>.fields).member);
}

template <Described T>
const void* initialValue() {
  static const T value{};
  return &value;
}

template <Described T, std::size_t... kIndices>
consteval auto makeFieldTypes(std::index_sequence<kIndices...>) {
  return std::array{
      FieldType{std::get<kIndices>(kRows<T>.fields).name, &std::get<kIndices>(kRows<T>.fields).notes,
                std::get<kIndices>(kRows<T>.fields).inlined,
                &kValueType<typename std::remove_cvref_t<decltype(std::get<kIndices>(kRows<T>.fields))>::Member>,
                memberAt<T, kIndices>}...};
}

template <Described T>
inline constexpr auto kFieldTypes = makeFieldTypes<T>(std::make_index_sequence<kRowCount<T>>());

template <Described T>
inline constexpr StructType kStructType{kRows<T>.name,         kRows<T>.says,  kFieldTypes<T>,
                                        kRows<T>.alternatives, kRows<T>.reply, initialValue<T>};

template <class T>
struct ContainerOf {
  static constexpr bool exists = false;
};

template <class T>
struct ContainerOf<std::optional<T>> {
  static constexpr bool exists = true;
  using Element = T;
  static constexpr auto kind = ValueType::Kind::optional;
  static constexpr std::size_t arraySize = 0;
  static std::size_t size(const std::optional<T>& value) { return value ? 1 : 0; }
  static const T& at(const std::optional<T>& value, std::size_t) { return *value; }
  static std::optional<T> make(std::size_t) { return T{}; }
};

template <class T, std::size_t kSize>
struct ContainerOf<std::array<T, kSize>> {
  static constexpr bool exists = true;
  using Element = T;
  static constexpr auto kind = ValueType::Kind::array;
  static constexpr std::size_t arraySize = kSize;
  static std::size_t size(const std::array<T, kSize>&) { return kSize; }
  static const T& at(const std::array<T, kSize>& value, std::size_t index) { return value[index]; }
  static std::array<T, kSize> make(std::size_t) { return {}; }
};

template <class T>
struct ContainerOf<std::vector<T>> {
  static constexpr bool exists = true;
  using Element = T;
  static constexpr auto kind = ValueType::Kind::list;
  static constexpr std::size_t arraySize = 0;
  static std::size_t size(const std::vector<T>& value) { return value.size(); }
  static const T& at(const std::vector<T>& value, std::size_t index) { return value[index]; }
  static std::vector<T> make(std::size_t count) { return std::vector<T>(count); }
};

template <class T>
consteval ValueType makeContainerType() {
  using Container = ContainerOf<T>;
  using Element = typename Container::Element;
  ValueType type{.kind = Container::kind};
  type.element = &kValueType<Element>;
  type.arraySize = Container::arraySize;
  type.size = [](const void* container) { return Container::size(valueAs<T>(container)); };
  type.at = [](const void* container, std::size_t index) -> const void* {
    return &Container::at(valueAs<T>(container), index);
  };
  if constexpr (Container::kind == ValueType::Kind::list && std::equality_comparable<Element>) {
    type.equal = [](const void* element, const void* other) {
      return valueAs<Element>(element) == valueAs<Element>(other);
    };
  }
  type.make = [](void* out, std::size_t count, const std::function<bool(void*)>& fill) {
    T container = Container::make(count);
    const bool filled = fill(&container);
    if (filled) valueAs<T>(out) = std::move(container);
    return filled;
  };
  if constexpr (Container::kind == ValueType::Kind::optional) {
    type.orMake = [](void* optional) -> void* {
      T& value = valueAs<T>(optional);
      return value ? &*value : &value.emplace();
    };
  }
  return type;
}

template <class T>
consteval ValueType makeValueType() {
  using Kind = ValueType::Kind;
  if constexpr (Custom<T>) {
    return {.kind = Kind::custom, .custom = &kCustomType<T>};
  } else if constexpr (Described<T>) {
    return {.kind = Kind::object, .object = &kStructType<T>};
  } else if constexpr (ContainerOf<T>::exists) {
    return makeContainerType<T>();
  } else if constexpr (Spelled<T>) {
    static_assert(spellsAll<T>(), "an enumerator has no spelling");
    return {.kind = Kind::word,
            .spellings = kSpellings<T>,
            .retired = kRetiredWords<T>,
            .wordIndex = [](const void* word) { return static_cast<int>(valueAs<T>(word)); },
            .setWord = [](void* word, int index) { valueAs<T>(word) = static_cast<T>(index); }};
  } else if constexpr (std::same_as<T, bool>) {
    return {.kind = Kind::boolean};
  } else if constexpr (std::same_as<T, int>) {
    return {.kind = Kind::integer};
  } else if constexpr (std::same_as<T, std::int64_t>) {
    return {.kind = Kind::integer64};
  } else if constexpr (std::same_as<T, std::uint64_t>) {
    return {.kind = Kind::unsigned64};
  } else if constexpr (std::same_as<T, double>) {
    return {.kind = Kind::number};
  } else if constexpr (std::same_as<T, std::string>) {
    return {.kind = Kind::text};
  } else {
    static_assert(std::same_as<T, std::variant<int, std::string>>, "a field can't have this type");
    return {.kind = Kind::indexOrName};
  }
}

template <class T>
const ValueType& typeOf() {
  return kValueType<T>;
}

} // namespace gnomon
