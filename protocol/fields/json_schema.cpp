#include "protocol/fields/json_schema.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "protocol/fields/field_codec.h"

namespace gnomon {
namespace {

/// Whole bounds are written without a fraction, as the bounds of an integer should be.
Json bound(double value) {
  if (value == std::trunc(value) && std::abs(value) < 1e15) return static_cast<std::int64_t>(value);
  return value;
}

void addRange(const Range& range, Json& schema) {
  if (std::isfinite(range.min)) schema[range.minOpen ? "exclusiveMinimum" : "minimum"] = bound(range.min);
  if (std::isfinite(range.max)) schema[range.maxOpen ? "exclusiveMaximum" : "maximum"] = bound(range.max);
}

Json booleanSchema(const Notes& notes) {
  Json schema = {{"type", "boolean"}};
  if (notes.onlyTrue) schema["const"] = true;
  return schema;
}

Json integerSchema(const Notes& notes) {
  Json schema = {{"type", "integer"}};
  addRange(notes.range, schema);
  for (std::size_t i = 0; i < notes.choices.count; ++i) schema["enum"].push_back(notes.choices.values[i]);
  return schema;
}

Json numberSchema(const Notes& notes) {
  Json schema = {{"type", "number"}};
  addRange(notes.range, schema);
  return schema;
}

Json textSchema(const Notes& notes) {
  Json schema = {{"type", "string"}};
  if (notes.minCount > 0) schema["minLength"] = notes.minCount;
  if (notes.maxCount != Notes{}.maxCount) schema["maxLength"] = notes.maxCount;
  return schema;
}

Json spellingSchema(std::span<const Spelling> spellings) {
  Json words = Json::array();
  for (const Spelling& spelling : spellings) words.push_back(std::string(spelling.name));
  return {{"type", "string"}, {"enum", words}};
}

Json arraySchema(const ValueType& type, const Notes& notes, Json& components) {
  return {{"type", "array"},
          {"items", schemaOf(*type.element, notes, components)},
          {"minItems", type.arraySize},
          {"maxItems", type.arraySize}};
}

Json listSchema(const ValueType& type, const Notes& notes, Json& components) {
  const Notes ofElements{.says = "", .range = notes.range};
  Json schema = {{"type", "array"}, {"items", schemaOf(*type.element, ofElements, components)}};
  if (notes.minCount > 0) schema["minItems"] = notes.minCount;
  if (notes.maxCount != Notes{}.maxCount) schema["maxItems"] = notes.maxCount;
  if (notes.distinct) schema["uniqueItems"] = true;
  return schema;
}

/// Adds to `schema` every field of the struct; an inlined one's as if they were its own.
void addProperties(const StructType& type, Json& schema, Json& components, bool inner) {
  using Kind = ValueType::Kind;
  for (const FieldType& field : type.fields) {
    if (field.inlined) {
      addProperties(*field.type->element->object, schema, components, true);
      continue;
    }
    Json property = schemaOf(*field.type, *field.notes, components);
    property["description"] = describe(*field.notes, *field.type);
    if (!field.notes->unit.empty()) property["x-unit"] = std::string(field.notes->unit);
    if (field.type->kind != Kind::optional) {
      if (type.reply) {
        schema["required"].push_back(std::string(field.name));
      } else if (field.type->kind != Kind::object && !inner) {
        property["default"] = encodeValue(*field.type, field.member(type.initial()));
      }
    }
    schema["properties"][std::string(field.name)] = std::move(property);
  }
}

/// The JSON keys of the field `name`: several where that is an inlined struct.
std::vector<std::string_view> keysOf(const StructType& type, std::string_view name) {
  std::vector<std::string_view> keys;
  for (const FieldType& field : type.fields) {
    if (field.name != name) continue;
    if (field.inlined) {
      appendKeys(*field.type->element->object, keys);
    } else {
      keys.push_back(field.name);
    }
  }
  return keys;
}

/// "Not both" for each two alternatives.
void addAlternatives(const StructType& type, Json& schema) {
  for (const Alternatives& group : type.alternatives) {
    for (std::size_t i = 0; i < group.size(); ++i) {
      for (std::size_t j = i + 1; j < group.size(); ++j) {
        for (const std::string_view first : keysOf(type, group[i])) {
          for (const std::string_view second : keysOf(type, group[j])) {
            const Json both = {{"required", {std::string(first), std::string(second)}}};
            schema["allOf"].push_back({{"not", both}});
          }
        }
      }
    }
  }
}

Json structSchema(const StructType& type, Json& components) {
  const std::string name(type.name);
  if (!components.contains(name)) {
    components[name] = Json::object(); // keeps its place before what it refers to
    Json schema = {{"type", "object"},
                   {"description", std::string(type.says)},
                   {"additionalProperties", false},
                   {"properties", Json::object()}};
    addProperties(type, schema, components, false);
    addAlternatives(type, schema);
    components[name] = std::move(schema);
  }
  return {{"$ref", "#/components/schemas/" + name}};
}

/// The type itself, or the one that an optional or a list holds.
const ValueType& wordsOf(const ValueType& type) {
  const bool holds = type.kind == ValueType::Kind::optional || type.kind == ValueType::Kind::list;
  return holds ? wordsOf(*type.element) : type;
}

} // namespace

Json schemaOf(const ValueType& type, const Notes& notes, Json& components) {
  using Kind = ValueType::Kind;
  switch (type.kind) {
    case Kind::boolean:
      return booleanSchema(notes);
    case Kind::integer:
    case Kind::integer64:
    case Kind::unsigned64:
      return integerSchema(notes);
    case Kind::number:
      return numberSchema(notes);
    case Kind::text:
      return textSchema(notes);
    case Kind::indexOrName:
      return {{"oneOf", Json::array({integerSchema(notes), textSchema(notes)})}};
    case Kind::word:
      return spellingSchema(type.spellings);
    case Kind::optional:
      return schemaOf(*type.element, notes, components);
    case Kind::array:
      return arraySchema(type, notes, components);
    case Kind::list:
      return listSchema(type, notes, components);
    case Kind::object:
      return structSchema(*type.object, components);
    case Kind::custom:
      return type.custom->schema();
  }
  return {};
}

std::string describe(const Notes& notes, const ValueType& type) {
  std::string text(notes.says);
  std::string words;
  for (const Spelling& spelling : wordsOf(type).spellings) {
    if (spelling.says.empty()) continue;
    words += words.empty() ? " " : "; ";
    words += std::string(spelling.name) + " = " + std::string(spelling.says);
  }
  if (!words.empty()) text += words + ".";
  if (!notes.unit.empty()) text += " Unit: " + std::string(notes.unit) + ".";
  return text;
}

} // namespace gnomon
