#include "protocol/fields/json_schema.h"

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

} // namespace

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

std::string describe(const Notes& notes, std::span<const Spelling> spellings) {
  std::string text(notes.says);
  std::string words;
  for (const Spelling& spelling : spellings) {
    if (spelling.says.empty()) continue;
    words += words.empty() ? " " : "; ";
    words += std::string(spelling.name) + " = " + std::string(spelling.says);
  }
  if (!words.empty()) text += words + ".";
  if (!notes.unit.empty()) text += " Unit: " + std::string(notes.unit) + ".";
  return text;
}

} // namespace gnomon
