#include "renderer/scene/checks/gltf_schema.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

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

/// Members that mean nothing without another one of the same object.
struct Dependency {
  std::string_view owner;
  std::string_view key;
  std::string_view needed;
};
constexpr std::array kDependencies{Dependency{"accessor", "byteOffset", "bufferView"},
                                   Dependency{"node", "weights", "mesh"}, Dependency{"node", "skin", "mesh"}};

/// Objects of which a faulty one is left out, and what comes of that. The others refuse the file.
struct Part {
  std::string_view owner;
  const char* remedy;
};
constexpr const char* kPartLeftOut = "what needs it is left out";
constexpr std::array kParts{Part{"accessor", kPartLeftOut},
                            Part{"bufferView", kPartLeftOut},
                            Part{"buffer", kPartLeftOut},
                            Part{"camera", "the camera is left out"},
                            Part{"light", "the light is left out"},
                            Part{"imageBasedLight", "the light is left out"},
                            Part{"animation", "the animation is left out"},
                            Part{"channel", "the animation's channel is left out"},
                            Part{"animation.sampler", "the animation's channels that use it are left out"}};

/// Arrays of the root's extensions that indices point into, by the name that they have in gltf_fields.cpp.
struct ExtensionArray {
  std::string_view extension;
  std::string_view key;
  std::string_view name;
};
constexpr std::array kExtensionArrays{ExtensionArray{"KHR_lights_punctual", "lights", "lights"},
                                      ExtensionArray{"KHR_materials_variants", "variants", "variants"},
                                      ExtensionArray{"EXT_lights_image_based", "lights", "imageBasedLights"}};

/// Of a range; 1 where it has one end.
constexpr double kNumberRounding = 1e-4;

const Repair kRounded{"A number is beyond its limit by rounding", "it is brought to the limit"};
const Repair kNotListed{"A value is in no list of glTF", "the default is used"};
const Repair kTwice{"An index is listed twice", "it counts once"};
const Repair kJointTwice{"A skin lists a joint twice", "both move what they move"};
const Repair kEmptyArray{"An array has no elements, which glTF forbids", "it is read as if it were not there"};

/// The limit that a number is beyond by no more than rounding.
std::optional<double> limitRounded(const GltfField& field, double value) {
  const double range = field.max - field.min;
  const double most = kNumberRounding * (std::isfinite(range) ? range : 1);
  if (value > field.max && value - field.max <= most) return field.max;
  if (value < field.min && field.min - value <= most && !field.minExcluded) return field.min;
  return std::nullopt;
}

class SchemaCheck {
 public:
  SchemaCheck(const json& document, Findings& findings)
      : findings_(&findings), used_(namesIn(document, "extensionsUsed")) {
    for (const GltfField& field : gltfFields()) {
      fieldsOf_[field.owner].push_back(&field);
      if (field.owner.ends_with(".extensions")) placed_.insert(std::string(field.key));
      if (field.owner == "root" && field.kind == FieldKind::objects) sizes_[field.key] = sizeOf(document, field.key);
    }
    for (const ExtensionArray& each : kExtensionArrays) {
      const json::json_pointer holder = json::json_pointer("/extensions") / std::string(each.extension);
      if (document.contains(holder)) sizes_[each.name] = sizeOf(document[holder], each.key);
    }
  }

  void checkObject(json& object, std::string_view owner, const std::string& pointer) {
    if (!object.is_object()) return wrongType(pointer, "an object", object);
    if (owner == "animation") sizes_["animation.samplers"] = sizeOf(object, "samplers");
    checkDependencies(object, owner, pointer);
    checkExtensionsOf(object, owner, pointer);
    for (const GltfField* field : fieldsOf_[owner]) {
      const auto member = object.find(field->key);
      if (member != object.end()) {
        checkField(*field, *member, pointerTo(pointer, field->key));
        if (member->is_null()) object.erase(member);
      } else if (field->required) {
        findings_->invalid(pointerTo(pointer, field->key), "The required member is missing.");
      }
    }
  }

 private:
  static std::size_t sizeOf(const json& object, std::string_view key) {
    const auto member = object.find(key);
    return member != object.end() && member->is_array() ? member->size() : 0;
  }

  void checkDependencies(const json& object, std::string_view owner, const std::string& pointer) {
    for (const Dependency& each : kDependencies) {
      if (each.owner != owner || !object.contains(each.key) || object.contains(each.needed)) continue;
      const std::string member(each.key);
      findings_->repair({'`' + member + "` is there without `" + std::string(each.needed) + '`', "it changes nothing"},
                        pointerTo(pointer, member));
    }
  }

  /// Of those that are read: whether they stand where they mean something, and are listed.
  void checkExtensionsOf(const json& object, std::string_view owner, const std::string& pointer) {
    const auto extensions = object.find("extensions");
    if (extensions == object.end() || !extensions->is_object()) return;
    const std::vector<const GltfField*>& own = fieldsOf_[owner];
    const auto row = std::ranges::find(own, std::string_view("extensions"), &GltfField::key);
    const auto rows = row == own.end() ? fieldsOf_.end() : fieldsOf_.find((*row)->of);
    for (const auto& [name, extension] : extensions->items()) {
      const std::string at = pointerTo(pointer + "/extensions", name);
      if (!used_.contains(name)) {
        findings_->repair({"The extension " + inQuotes(name) + " is used and not listed in `extensionsUsed`",
                           isSupported(name) ? "it is read" : "its additions are not drawn"},
                          at);
      }
      const auto isNamed = [&name = name](const GltfField* field) { return field->key == name; };
      const bool isRead = rows != fieldsOf_.end() && std::ranges::any_of(rows->second, isNamed);
      if (placed_.contains(name) && !isRead) {
        findings_->repair(
            {"The extension " + inQuotes(name) + " stands where it means nothing", "it is not read there"}, at);
      }
    }
  }

  void wrongType(const std::string& pointer, std::string_view expected, const json& value) {
    findings_->invalid(pointer, "The value is not " + std::string(expected) + ".", std::string(expected),
                       textOf(value));
  }

  /// Leaves null where the value counts as if the member were not there.
  void checkField(const GltfField& field, json& value, const std::string& pointer) {
    if (!field.allowed.empty() && !field.required && !field.noDefault && !isListed(field, value)) {
      findings_->repair(kNotListed, pointer, rangeOf(field), textOf(value));
      value = nullptr;
      return;
    }
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
        return checkMap(field, value, pointer, &SchemaCheck::checkReference);
      case FieldKind::integerMap:
        return checkMap(field, value, pointer, &SchemaCheck::checkInteger);
      case FieldKind::numbers:
      case FieldKind::strings:
      case FieldKind::references:
      case FieldKind::referenceMaps:
      case FieldKind::objects:
        return checkArray(field, value, pointer, field.length);
      case FieldKind::numberRows:
      case FieldKind::referenceRows:
        return checkArray(field, value, pointer, field.rows);
    }
  }

  static bool isListed(const GltfField& field, json& value) {
    if (field.kind == FieldKind::integer) return makeInteger(value) && isAllowed(field, value.dump());
    return value.is_string() && isAllowed(field, value.get_ref<const std::string&>());
  }

  void outOfRange(const GltfField& field, const json& value, const std::string& pointer) {
    findings_->invalid(pointer, "glTF does not allow this value here.", rangeOf(field), textOf(value));
  }

  void checkNumber(const GltfField& field, json& value, const std::string& pointer) {
    if (!value.is_number()) return wrongType(pointer, "a number", value);
    const double number = value.get<double>();
    if (inRange(field, number)) return;
    if (const auto limit = limitRounded(field, number)) {
      findings_->repair(kRounded, pointer, rangeOf(field), textOf(value));
      value = *limit;
    } else {
      outOfRange(field, value, pointer);
    }
  }

  void checkInteger(const GltfField& field, json& value, const std::string& pointer) {
    if (!makeInteger(value)) return wrongType(pointer, "a whole number", value);
    if (!inRange(field, value.get<double>()) || !isAllowed(field, value.dump())) outOfRange(field, value, pointer);
  }

  void checkReference(const GltfField& field, json& value, const std::string& pointer) {
    if (!makeInteger(value)) return wrongType(pointer, "an index", value);
    const std::size_t size = sizes_[field.of];
    const auto index = value.get<std::int64_t>(); // negative, too, from 2^63 on
    if (index >= 0 && static_cast<std::uint64_t>(index) < size) return;
    findings_->invalid(pointer, "The index is out of range of " + std::string(field.of) + ".",
                       size == 0 ? "none" : "0.." + std::to_string(size - 1), textOf(value));
  }

  /// `check`: of each of its values.
  void checkMap(const GltfField& field, json& value, const std::string& pointer,
                void (SchemaCheck::*check)(const GltfField&, json&, const std::string&)) {
    if (!value.is_object()) return wrongType(pointer, "an object", value);
    for (auto& [key, each] : value.items()) (this->*check)(field, each, pointerTo(pointer, key));
  }

  /// `length`: 0 = any.
  void checkArray(const GltfField& field, json& value, const std::string& pointer, std::size_t length) {
    if (!value.is_array()) return wrongType(pointer, "an array", value);
    if (length != 0 && value.size() != length) {
      findings_->invalid(pointer, "The array has the wrong length.", std::to_string(length),
                         std::to_string(value.size()));
    }
    if (value.empty()) findings_->repair(kEmptyArray, pointer);
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
          if (seen.insert(value[i]).second) break;
          if (field.key == "joints") { // their numbers stand in the vertices
            findings_->repair(kJointTwice, at, {}, textOf(value[i]));
          } else {
            findings_->repair(kTwice, at, {}, textOf(value[i]));
            value[i] = nullptr;
          }
          break;
        case FieldKind::numberRows:
          checkRow(field, value[i], at, &SchemaCheck::checkNumber);
          break;
        case FieldKind::referenceRows:
          checkRow(field, value[i], at, &SchemaCheck::checkReference);
          break;
        case FieldKind::referenceMaps:
          checkMap(field, value[i], at, &SchemaCheck::checkReference);
          break;
        default:
          checkElement(value[i], field.of, at);
      }
    }
    if (field.kind == FieldKind::references) {
      value.erase(std::remove(value.begin(), value.end(), nullptr), value.end());
    }
  }

  /// `check`: of each of its values.
  void checkRow(const GltfField& field, json& value, const std::string& pointer,
                void (SchemaCheck::*check)(const GltfField&, json&, const std::string&)) {
    if (!value.is_array()) return wrongType(pointer, "an array", value);
    if (value.size() != field.length) {
      findings_->invalid(pointer, "The array has the wrong length.", std::to_string(field.length),
                         std::to_string(value.size()));
    }
    for (std::size_t i = 0; i < value.size(); ++i) (this->*check)(field, value[i], pointerTo(pointer, i));
  }

  /// Puts into the place of a faulty part why it is left out, and its name.
  void checkElement(json& value, std::string_view owner, const std::string& pointer) {
    const auto part = std::ranges::find(kParts, owner, &Part::owner);
    if (part == kParts.end()) return checkObject(value, owner, pointer);
    Findings ofPart;
    Findings* const whole = std::exchange(findings_, &ofPart);
    checkObject(value, owner, pointer);
    findings_ = whole;
    const std::string why = findings_->leaveOut(std::move(ofPart), part->remedy);
    if (why.empty()) return;
    const auto name = value.find("name");
    value = json::array({why, name != value.end() && name->is_string() ? *name : json("")});
  }

  Findings* findings_;           ///< of the part that is looked at
  std::set<std::string> used_;   ///< extensions that the file lists
  std::set<std::string> placed_; ///< extensions with members of their own that are read somewhere
  std::map<std::string_view, std::vector<const GltfField*>> fieldsOf_;
  std::map<std::string_view, std::size_t> sizes_; ///< of the arrays that indices point into
};

} // namespace

void checkSchema(json& document, Findings& findings) {
  SchemaCheck(document, findings).checkObject(document, "root", "");
}

} // namespace gnomon
