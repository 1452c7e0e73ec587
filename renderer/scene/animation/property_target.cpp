#include "renderer/scene/animation/property_target.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>

#include "renderer/scene/checks/gltf_fields.h"
#include "renderer/scene/gltf_json.h"

namespace gnomon {

namespace {

using nlohmann::json;

constexpr std::string_view kRoots[] = {"/materials/", "/cameras/", "/extensions/KHR_lights_punctual/lights/"};

/// Checked, but nothing is drawn by them: a frame has an aspect ratio of its own.
constexpr std::string_view kUnused[] = {"aspectRatio", "xmag"};

const GltfField* fieldOf(std::string_view owner, std::string_view key) {
  const auto fields = gltfFields();
  const auto found =
      std::ranges::find_if(fields, [&](const GltfField& field) { return field.owner == owner && field.key == key; });
  return found == fields.end() ? nullptr : &*found;
}

const json* elementOf(const json& array, std::string_view token) {
  const auto index = indexIn(token, array.size());
  return index ? &array[*index] : nullptr;
}

/// Takes the first token off a pointer.
std::string_view nextToken(std::string_view& pointer) {
  pointer.remove_prefix(1);
  const std::string_view token = pointer.substr(0, pointer.find('/'));
  pointer.remove_prefix(token.size());
  return token;
}

} // namespace

std::optional<PropertyTarget> propertyAt(const json& document, const std::string& pointer) {
  if (std::ranges::none_of(kRoots, [&](std::string_view root) { return pointer.starts_with(root); })) {
    return std::nullopt;
  }
  std::string_view left = pointer;
  std::string_view owner = "root";
  const json* object = &document;
  while (!left.empty() && object != nullptr) {
    const GltfField* field = fieldOf(owner, nextToken(left));
    if (field == nullptr || std::ranges::find(kUnused, field->key) != std::end(kUnused)) return std::nullopt;
    if (left.empty()) {
      const bool isArray = field->kind == FieldKind::numbers && field->length > 0;
      if (!isArray && field->kind != FieldKind::number) return std::nullopt;
      return PropertyTarget{pointer, isArray, isArray ? field->length : 1, field->min, field->max, field->minExcluded};
    }
    const json* member = memberOf(*object, field->key);
    if (field->kind == FieldKind::objects) {
      object = member == nullptr ? nullptr : elementOf(*member, nextToken(left));
    } else if (field->kind == FieldKind::object) {
      static const json kDefaults = json::object();
      object = member == nullptr && field->of == "pbr" ? &kDefaults : member;
    } else {
      return std::nullopt;
    }
    owner = field->of;
  }
  return std::nullopt;
}

} // namespace gnomon
