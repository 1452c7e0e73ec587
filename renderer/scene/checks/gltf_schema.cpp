#include "renderer/scene/checks/gltf_schema.h"

#include <cmath>
#include <map>
#include <set>

#include "renderer/scene/checks/gltf_fields.h"

namespace gnomon {

namespace {

using nlohmann::json;

constexpr double kMaxExactInteger = 9007199254740992.0; // 2^53

std::string textOf(const json& value) {
  if (value.is_object()) return "an object";
  if (value.is_array()) return "an array of " + std::to_string(value.size());
  if (value.is_string()) return inQuotes(value.get_ref<const std::string&>());
  return value.dump();
}

/// A bound as a person writes it: whole numbers without a fraction.
std::string textOf(double value) {
  if (std::abs(value) < kMaxExactInteger && value == std::trunc(value)) {
    return std::to_string(static_cast<std::int64_t>(value));
  }
  return json(value).dump();
}

std::string rangeOf(const GltfField& field) {
  if (!field.allowed.empty()) return std::string(field.allowed);
  const std::string low = std::isinf(field.min) ? "" : (field.minExcluded ? "> " : ">= ") + textOf(field.min);
  const std::string high = std::isinf(field.max) ? "" : "<= " + textOf(field.max);
  return low.empty() || high.empty() ? low + high : low + " and " + high;
}

bool inRange(const GltfField& field, double value) {
  return std::isfinite(value) && (field.minExcluded ? value > field.min : value >= field.min) && value <= field.max;
}

bool isAllowed(const GltfField& field, const std::string& text) {
  return field.allowed.empty() ||
         (!text.empty() && text.find(' ') == std::string::npos &&
          (' ' + std::string(field.allowed) + ' ').find(' ' + text + ' ') != std::string::npos);
}

/// Turns 3.0 into 3; false if the value is not a whole number.
bool makeInteger(json& value) {
  if (value.is_number_integer()) return true;
  if (!value.is_number_float()) return false;
  const double number = value.get<double>();
  if (std::abs(number) >= kMaxExactInteger || number != std::trunc(number)) return false;
  value = static_cast<std::int64_t>(number);
  return true;
}

class SchemaCheck {
 public:
  SchemaCheck(const json& document, Findings& findings) : findings_(findings) {
    for (const GltfField& field : gltfFields()) {
      fieldsOf_[field.owner].push_back(&field);
      if (field.owner == "root" && field.kind == FieldKind::objects) sizes_[field.key] = sizeOf(document, field.key);
    }
    const auto extensions = document.find("extensions");
    if (extensions != document.end() && extensions->is_object()) {
      const auto lights = extensions->find("KHR_lights_punctual");
      if (lights != extensions->end() && lights->is_object()) sizes_["lights"] = sizeOf(*lights, "lights");
      const auto variants = extensions->find("KHR_materials_variants");
      if (variants != extensions->end() && variants->is_object()) sizes_["variants"] = sizeOf(*variants, "variants");
    }
  }

  void checkObject(json& object, std::string_view owner, const std::string& pointer) {
    if (!object.is_object()) return wrongType(pointer, "an object", object);
    if (owner == "animation") sizes_["animation.samplers"] = sizeOf(object, "samplers");
    for (const GltfField* field : fieldsOf_[owner]) {
      const auto member = object.find(field->key);
      if (member != object.end()) {
        checkField(*field, *member, pointerTo(pointer, field->key));
      } else if (field->required) {
        findings_.invalid(pointerTo(pointer, field->key), "The required member is missing.");
      }
    }
  }

 private:
  static std::size_t sizeOf(const json& object, std::string_view key) {
    const auto member = object.find(key);
    return member != object.end() && member->is_array() ? member->size() : 0;
  }

  void wrongType(const std::string& pointer, std::string_view expected, const json& value) {
    findings_.invalid(pointer, "The value is not " + std::string(expected) + ".", std::string(expected), textOf(value));
  }

  void checkField(const GltfField& field, json& value, const std::string& pointer) {
    switch (field.kind) {
      case FieldKind::boolean:
        if (!value.is_boolean()) wrongType(pointer, "true or false", value);
        return;
      case FieldKind::number:
        return checkNumber(field, value, pointer);
      case FieldKind::integer:
        return checkInteger(field, value, pointer);
      case FieldKind::string:
        if (!value.is_string()) return wrongType(pointer, "a string", value);
        if (!isAllowed(field, value.get_ref<const std::string&>())) outOfRange(field, value, pointer);
        return;
      case FieldKind::reference:
        return checkReference(field, value, pointer);
      case FieldKind::object:
        return checkObject(value, field.of, pointer);
      case FieldKind::referenceMap:
        return checkReferenceMap(field, value, pointer);
      case FieldKind::integerMap:
        return checkIntegerMap(field, value, pointer);
      case FieldKind::numbers:
      case FieldKind::strings:
      case FieldKind::references:
      case FieldKind::referenceMaps:
      case FieldKind::objects:
        return checkArray(field, value, pointer);
    }
  }

  void outOfRange(const GltfField& field, const json& value, const std::string& pointer) {
    findings_.invalid(pointer, "glTF does not allow this value here.", rangeOf(field), textOf(value));
  }

  void checkNumber(const GltfField& field, const json& value, const std::string& pointer) {
    if (!value.is_number()) return wrongType(pointer, "a number", value);
    if (!inRange(field, value.get<double>())) outOfRange(field, value, pointer);
  }

  void checkInteger(const GltfField& field, json& value, const std::string& pointer) {
    if (!makeInteger(value)) return wrongType(pointer, "a whole number", value);
    if (!inRange(field, value.get<double>()) || !isAllowed(field, value.dump())) outOfRange(field, value, pointer);
  }

  void checkReference(const GltfField& field, json& value, const std::string& pointer) {
    if (!makeInteger(value)) return wrongType(pointer, "an index", value);
    const std::size_t size = sizes_[field.of];
    const bool exists = value.is_number_unsigned() ? value.get<std::uint64_t>() < size
                                                   : value.get<std::int64_t>() >= 0 &&
                                                         static_cast<std::uint64_t>(value.get<std::int64_t>()) < size;
    if (exists) return;
    findings_.invalid(pointer, "The index is out of range of " + std::string(field.of) + ".",
                      size == 0 ? "none" : "0.." + std::to_string(size - 1), textOf(value));
  }

  void checkReferenceMap(const GltfField& field, json& value, const std::string& pointer) {
    if (!value.is_object()) return wrongType(pointer, "an object", value);
    for (auto& [key, index] : value.items()) checkReference(field, index, pointerTo(pointer, key));
  }

  void checkIntegerMap(const GltfField& field, json& value, const std::string& pointer) {
    if (!value.is_object()) return wrongType(pointer, "an object", value);
    for (auto& [key, number] : value.items()) checkInteger(field, number, pointerTo(pointer, key));
  }

  void checkArray(const GltfField& field, json& value, const std::string& pointer) {
    if (!value.is_array()) return wrongType(pointer, "an array", value);
    if (field.length != 0 && value.size() != field.length) {
      findings_.invalid(pointer, "The array has the wrong length.", std::to_string(field.length),
                        std::to_string(value.size()));
    }
    std::set<json> seen;
    for (std::size_t i = 0; i < value.size(); ++i) {
      const std::string at = pointerTo(pointer, i);
      switch (field.kind) {
        case FieldKind::numbers:
          checkNumber(field, value[i], at);
          break;
        case FieldKind::strings:
          if (!value[i].is_string()) wrongType(at, "a string", value[i]);
          break;
        case FieldKind::references:
          checkReference(field, value[i], at);
          if (!seen.insert(value[i]).second) findings_.invalid(at, "The array contains the index twice.");
          break;
        case FieldKind::referenceMaps:
          checkReferenceMap(field, value[i], at);
          break;
        default:
          checkObject(value[i], field.of, at);
      }
    }
  }

  Findings& findings_;
  std::map<std::string_view, std::vector<const GltfField*>> fieldsOf_;
  std::map<std::string_view, std::size_t> sizes_; ///< of the arrays that indices point into
};

} // namespace

void checkSchema(json& document, Findings& findings) {
  SchemaCheck(document, findings).checkObject(document, "root", "");
}

} // namespace gnomon
