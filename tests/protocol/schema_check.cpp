#include "tests/protocol/schema_check.h"

#include <cmath>
#include <set>

namespace gnomon {
namespace {

bool hasType(const Json& value, const std::string& type) {
  if (type == "object") return value.is_object();
  if (type == "array") return value.is_array();
  if (type == "string") return value.is_string();
  if (type == "boolean") return value.is_boolean();
  if (type == "number") return value.is_number();
  if (type == "integer") return value.is_number() && value.get<double>() == std::trunc(value.get<double>());
  return false;
}

bool fitsNumber(double value, const std::string& keyword, double bound) {
  if (keyword == "minimum") return value >= bound;
  if (keyword == "maximum") return value <= bound;
  if (keyword == "exclusiveMinimum") return value > bound;
  return value < bound;
}

bool areDistinct(const Json& array) {
  std::set<std::string> seen;
  for (const Json& element : array) {
    if (!seen.insert(element.dump()).second) return false;
  }
  return true;
}

bool fits(const Json& value, const Json& schema, const Json& document) {
  return checkAgainstSchema(value, schema, document) == "ok";
}

/// Keywords that look at the value as a whole.
bool fitsWhole(const Json& value, const std::string& keyword, const Json& rule, const Json& document) {
  if (keyword == "type") return hasType(value, rule);
  if (keyword == "const") return value == rule;
  if (keyword == "enum") return std::find(rule.begin(), rule.end(), value) != rule.end();
  if (keyword == "minimum" || keyword == "maximum" || keyword == "exclusiveMinimum" || keyword == "exclusiveMaximum") {
    return !value.is_number() || fitsNumber(value, keyword, rule);
  }
  if (keyword == "minItems") return !value.is_array() || value.size() >= rule.get<std::size_t>();
  if (keyword == "maxItems") return !value.is_array() || value.size() <= rule.get<std::size_t>();
  if (keyword == "uniqueItems") return !value.is_array() || areDistinct(value);
  if (keyword == "minLength") return !value.is_string() || value.get<std::string>().size() >= rule.get<std::size_t>();
  if (keyword == "maxLength") return !value.is_string() || value.get<std::string>().size() <= rule.get<std::size_t>();
  if (keyword == "required") {
    return !value.is_object() ||
           std::all_of(rule.begin(), rule.end(), [&](const Json& key) { return value.contains(key); });
  }
  if (keyword == "not") return !fits(value, rule, document);
  if (keyword == "allOf") {
    return std::all_of(rule.begin(), rule.end(), [&](const Json& each) { return fits(value, each, document); });
  }
  if (keyword == "oneOf") {
    return std::count_if(rule.begin(), rule.end(), [&](const Json& each) { return fits(value, each, document); }) == 1;
  }
  return keyword == "description" || keyword == "x-unit" || keyword == "default";
}

} // namespace

std::string checkAgainstSchema(const Json& value, const Json& schema, const Json& document, const std::string& at) {
  for (const auto& [keyword, rule] : schema.items()) {
    if (keyword == "$ref") {
      const Json& target = document.at(Json::json_pointer(rule.get<std::string>().substr(1)));
      if (const std::string result = checkAgainstSchema(value, target, document, at); result != "ok") return result;
    } else if (keyword == "properties") {
      for (const auto& [key, inner] : rule.items()) {
        if (!value.is_object() || !value.contains(key)) continue;
        const std::string result = checkAgainstSchema(value[key], inner, document, at + "/" + key);
        if (result != "ok") return result;
      }
    } else if (keyword == "additionalProperties") {
      const Json object = value.is_object() ? value : Json::object();
      for (const auto& [key, member] : object.items()) {
        if (schema.contains("properties") && schema["properties"].contains(key)) continue;
        if (rule == false) return at + "/" + key;
        const std::string result = checkAgainstSchema(member, rule, document, at + "/" + key);
        if (result != "ok") return result;
      }
    } else if (keyword == "items") {
      for (std::size_t i = 0; value.is_array() && i < value.size(); ++i) {
        const std::string result = checkAgainstSchema(value[i], rule, document, at + "/" + std::to_string(i));
        if (result != "ok") return result;
      }
    } else if (!fitsWhole(value, keyword, rule, document)) {
      return at;
    }
  }
  return "ok";
}

} // namespace gnomon
