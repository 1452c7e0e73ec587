#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "protocol/fields/field_decode.h"
#include "protocol/fields/field_encode.h"
#include "protocol/fields/fields.h"
#include "protocol/fields/spellings.h"
#include "protocol/report/frame_report.h"

/// JSON Schema (2020-12, as OpenAPI 3.1 has it) from the rows. A described struct becomes one of the components, by
/// its name, and is referred to.
namespace gnomon {

Json integerSchema(const Notes& notes);
Json numberSchema(const Notes& notes);
Json textSchema(const Notes& notes);
Json spellingSchema(std::span<const Spelling> spellings);

/// The row's sentence and unit, and what an enum's words mean.
std::string describe(const Notes& notes, std::span<const Spelling> spellings);

/// What a member's type is made into; `components` receives the structs that it refers to.
template <class T>
struct SchemaOf;

template <class T>
Json schemaOf(const Notes& notes, Json& components) {
  return SchemaOf<T>::make(notes, components);
}

template <>
struct SchemaOf<bool> {
  static Json make(const Notes& notes, Json&) {
    Json schema = {{"type", "boolean"}};
    if (notes.onlyTrue) schema["const"] = true;
    return schema;
  }
};

template <class T>
requires std::is_integral_v<T>
struct SchemaOf<T> {
  static Json make(const Notes& notes, Json&) { return integerSchema(notes); }
};

template <>
struct SchemaOf<double> {
  static Json make(const Notes& notes, Json&) { return numberSchema(notes); }
};

template <>
struct SchemaOf<std::string> {
  static Json make(const Notes& notes, Json&) { return textSchema(notes); }
};

template <Spelled Enum>
struct SchemaOf<Enum> {
  static Json make(const Notes&, Json&) { return spellingSchema(kSpellings<Enum>); }
};

template <class T>
struct SchemaOf<std::optional<T>> : SchemaOf<T> {};

template <class... Kinds>
struct SchemaOf<std::variant<Kinds...>> {
  static Json make(const Notes& notes, Json& components) {
    return {{"oneOf", Json::array({schemaOf<Kinds>(notes, components)...})}};
  }
};

template <class T, std::size_t kSize>
struct SchemaOf<std::array<T, kSize>> {
  static Json make(const Notes& notes, Json& components) {
    return {{"type", "array"}, {"items", schemaOf<T>(notes, components)}, {"minItems", kSize}, {"maxItems", kSize}};
  }
};

template <class T>
struct SchemaOf<std::vector<T>> {
  static Json make(const Notes& notes, Json& components) {
    Json schema = {{"type", "array"}, {"items", schemaOf<T>(Notes{.says = "", .range = notes.range}, components)}};
    if (notes.minCount > 0) schema["minItems"] = notes.minCount;
    if (notes.maxCount != Notes{}.maxCount) schema["maxItems"] = notes.maxCount;
    if (notes.distinct) schema["uniqueItems"] = true;
    return schema;
  }
};

template <>
struct SchemaOf<std::vector<StageTime>> {
  static Json make(const Notes&, Json&) {
    return {{"type", "object"}, {"additionalProperties", {{"type", "number"}, {"minimum", 0}}}};
  }
};

template <class T>
struct Unwrapped {
  using Type = T;
};
template <class T>
struct Unwrapped<std::optional<T>> : Unwrapped<T> {};
template <class T>
struct Unwrapped<std::vector<T>> : Unwrapped<T> {};

/// The spellings of an enum, or of the enum that a list or an optional holds.
template <class T>
std::span<const Spelling> spellingsIn() {
  return kSpellings<typename Unwrapped<T>::Type>;
}

/// Adds to `schema` every field of T; an inlined struct's as if they were T's own.
template <Described T>
void addProperties(Json& schema, Json& components, bool inner) {
  forEachField<T>([&]<class F>(const F& field) {
    using Member = typename F::Member;
    if constexpr (kIsOptionalStruct<Member>) {
      if (field.inlined) return addProperties<typename Member::value_type>(schema, components, true);
    }
    Json property = schemaOf<Member>(field.notes, components);
    property["description"] = describe(field.notes, spellingsIn<Member>());
    if (!field.notes.unit.empty()) property["x-unit"] = std::string(field.notes.unit);
    if constexpr (!kIsOptional<Member>) {
      if (kRows<T>.reply) {
        schema["required"].push_back(std::string(field.name));
      } else if (!Described<Member> && !inner) {
        property["default"] = encodeValue(T{}.*field.member);
      }
    }
    schema["properties"][std::string(field.name)] = std::move(property);
  });
}

/// The JSON keys of T's field `name`: several where that is an inlined struct.
template <Described T>
std::vector<std::string_view> keysOf(std::string_view name) {
  std::vector<std::string_view> keys;
  forEachField<T>([&]<class F>(const F& field) {
    if (field.name != name) return;
    if constexpr (kIsOptionalStruct<typename F::Member>) {
      if (field.inlined) return appendKeys<typename F::Member::value_type>(keys);
    }
    keys.push_back(field.name);
  });
  return keys;
}

/// "Not both" for each two alternatives.
template <Described T>
void addAlternatives(Json& schema) {
  for (const Alternatives& group : kRows<T>.alternatives) {
    for (std::size_t i = 0; i < group.size(); ++i) {
      for (std::size_t j = i + 1; j < group.size(); ++j) {
        for (const std::string_view first : keysOf<T>(group[i])) {
          for (const std::string_view second : keysOf<T>(group[j])) {
            const Json both = {{"required", {std::string(first), std::string(second)}}};
            schema["allOf"].push_back({{"not", both}});
          }
        }
      }
    }
  }
}

template <Described T>
struct SchemaOf<T> {
  static Json make(const Notes&, Json& components) {
    const std::string name(kRows<T>.name);
    if (!components.contains(name)) {
      components[name] = Json::object(); // keeps its place before what it refers to
      Json schema = {{"type", "object"},
                     {"description", std::string(kRows<T>.says)},
                     {"additionalProperties", false},
                     {"properties", Json::object()}};
      addProperties<T>(schema, components, false);
      addAlternatives<T>(schema);
      components[name] = std::move(schema);
    }
    return {{"$ref", "#/components/schemas/" + name}};
  }
};

} // namespace gnomon
