#include "renderer/scene/animation/property_target.h"

#include <algorithm>
#include <charconv>

#include "renderer/scene/checks/gltf_fields.h"

namespace gnomon {

namespace {

constexpr std::string_view kMaterials = "/materials/";
constexpr std::string_view kCameras = "/cameras/";
constexpr std::string_view kLights = "/extensions/KHR_lights_punctual/lights/";
constexpr std::string_view kTransform = "/extensions/KHR_texture_transform/";

/// Where a property stands below one of these, and the owner of its row in gltfFields(), which says its range.
struct PropertyRow {
  Property property;
  std::string_view root;
  std::string_view path;
  std::string_view owner;
};

constexpr PropertyRow kRows[] = {
    {Property::baseColorFactor, kMaterials, "pbrMetallicRoughness/baseColorFactor", "pbr"},
    {Property::metallicFactor, kMaterials, "pbrMetallicRoughness/metallicFactor", "pbr"},
    {Property::roughnessFactor, kMaterials, "pbrMetallicRoughness/roughnessFactor", "pbr"},
    {Property::normalScale, kMaterials, "normalTexture/scale", "normalTexture"},
    {Property::occlusionStrength, kMaterials, "occlusionTexture/strength", "occlusionTexture"},
    {Property::emissiveFactor, kMaterials, "emissiveFactor", "material"},
    {Property::emissiveStrength, kMaterials, "extensions/KHR_materials_emissive_strength/emissiveStrength",
     "emissiveStrength"},
    {Property::alphaCutoff, kMaterials, "alphaCutoff", "material"},
    {Property::transmissionFactor, kMaterials, "extensions/KHR_materials_transmission/transmissionFactor",
     "transmission"},
    {Property::diffuseFactor, kMaterials, "extensions/KHR_materials_pbrSpecularGlossiness/diffuseFactor",
     "specularGlossiness"},
    {Property::specularFactor, kMaterials, "extensions/KHR_materials_pbrSpecularGlossiness/specularFactor",
     "specularGlossiness"},
    {Property::glossinessFactor, kMaterials, "extensions/KHR_materials_pbrSpecularGlossiness/glossinessFactor",
     "specularGlossiness"},
    {Property::textureOffset, kTransform, "offset", "textureTransform"},
    {Property::textureRotation, kTransform, "rotation", "textureTransform"},
    {Property::textureScale, kTransform, "scale", "textureTransform"},
    {Property::yfov, kCameras, "perspective/yfov", "perspective"},
    {Property::perspectiveNear, kCameras, "perspective/znear", "perspective"},
    {Property::perspectiveFar, kCameras, "perspective/zfar", "perspective"},
    {Property::ymag, kCameras, "orthographic/ymag", "orthographic"},
    {Property::orthographicNear, kCameras, "orthographic/znear", "orthographic"},
    {Property::orthographicFar, kCameras, "orthographic/zfar", "orthographic"},
    {Property::lightColor, kLights, "color", "light"},
    {Property::lightIntensity, kLights, "intensity", "light"},
    {Property::lightRange, kLights, "range", "light"},
    {Property::innerCone, kLights, "spot/innerConeAngle", "spot"},
    {Property::outerCone, kLights, "spot/outerConeAngle", "spot"},
};

/// A material's textures by their paths; nullptr where the object that has the texture is missing.
struct TexturePlace {
  std::string_view path;
  std::optional<gltf::TextureInfo>* (*in)(gltf::Material&);
};

constexpr TexturePlace kTextures[] = {
    {"pbrMetallicRoughness/baseColorTexture", [](gltf::Material& m) { return &m.baseColorTexture; }},
    {"pbrMetallicRoughness/metallicRoughnessTexture", [](gltf::Material& m) { return &m.metallicRoughnessTexture; }},
    {"normalTexture", [](gltf::Material& m) { return &m.normalTexture; }},
    {"occlusionTexture", [](gltf::Material& m) { return &m.occlusionTexture; }},
    {"emissiveTexture", [](gltf::Material& m) { return &m.emissiveTexture; }},
    {"extensions/KHR_materials_pbrSpecularGlossiness/diffuseTexture",
     [](gltf::Material& m) { return m.specularGlossiness ? &m.specularGlossiness->diffuseTexture : nullptr; }},
    {"extensions/KHR_materials_pbrSpecularGlossiness/specularGlossinessTexture",
     [](gltf::Material& m) {
       return m.specularGlossiness ? &m.specularGlossiness->specularGlossinessTexture : nullptr;
     }},
    {"extensions/KHR_materials_transmission/transmissionTexture",
     [](gltf::Material& m) { return m.transmission ? &m.transmission->texture : nullptr; }},
};

std::span<double> spanOf(double& value) {
  return {&value, 1};
}
template <int kSize>
std::span<double> spanOf(glm::vec<kSize, double>& value) {
  return {&value[0], std::size_t{kSize}};
}

std::span<double> numbersIn(gltf::TextureTransform& transform, Property property) {
  if (property == Property::textureOffset) return spanOf(transform.offset);
  return property == Property::textureScale ? spanOf(transform.scale) : spanOf(transform.rotation);
}

/// Empty where the object that the property stands in is missing.
std::span<double> numbersIn(gltf::Material& material, const PropertyTarget& target) {
  auto& glossy = material.specularGlossiness;
  switch (target.property) {
    case Property::baseColorFactor:
      return spanOf(material.baseColorFactor);
    case Property::metallicFactor:
      return spanOf(material.metallicFactor);
    case Property::roughnessFactor:
      return spanOf(material.roughnessFactor);
    case Property::normalScale:
      return material.normalTexture ? spanOf(material.normalScale) : std::span<double>();
    case Property::occlusionStrength:
      return material.occlusionTexture ? spanOf(material.occlusionStrength) : std::span<double>();
    case Property::emissiveFactor:
      return spanOf(material.emissiveFactor);
    case Property::emissiveStrength:
      return material.emissiveStrength ? spanOf(*material.emissiveStrength) : std::span<double>();
    case Property::alphaCutoff:
      return spanOf(material.alphaCutoff);
    case Property::transmissionFactor:
      return material.transmission ? spanOf(material.transmission->factor) : std::span<double>();
    case Property::diffuseFactor:
      return glossy ? spanOf(glossy->diffuseFactor) : std::span<double>();
    case Property::specularFactor:
      return glossy ? spanOf(glossy->specularFactor) : std::span<double>();
    case Property::glossinessFactor:
      return glossy ? spanOf(glossy->glossinessFactor) : std::span<double>();
    default:
      break;
  }
  auto* info = kTextures[target.texture].in(material);
  return info && *info && (*info)->transform ? numbersIn(*(*info)->transform, target.property) : std::span<double>();
}

std::span<double> numbersIn(gltf::Camera& camera, const PropertyTarget& target) {
  if (auto& lens = camera.perspective) {
    if (target.property == Property::yfov) return spanOf(lens->yfov);
    if (target.property == Property::perspectiveNear) return spanOf(lens->znear);
    if (target.property == Property::perspectiveFar) return spanOf(lens->zfar);
  }
  if (auto& lens = camera.orthographic) {
    if (target.property == Property::ymag) return spanOf(lens->ymag);
    if (target.property == Property::orthographicNear) return spanOf(lens->znear);
    if (target.property == Property::orthographicFar) return spanOf(lens->zfar);
  }
  return {};
}

std::span<double> numbersIn(gltf::PunctualLight& light, const PropertyTarget& target) {
  switch (target.property) {
    case Property::lightColor:
      if (!light.color) light.color = glm::dvec3(1);
      return spanOf(*light.color);
    case Property::lightIntensity:
      return spanOf(light.intensity);
    case Property::lightRange:
      return spanOf(light.range);
    default:
      break;
  }
  if (!light.spot) return {};
  return spanOf(target.property == Property::innerCone ? light.spot->inner : light.spot->outer);
}

const PropertyRow* rowOf(std::string_view root, std::string_view path) {
  const auto* row = std::ranges::find_if(kRows, [&](const PropertyRow& r) { return r.root == root && r.path == path; });
  return row == std::end(kRows) ? nullptr : row;
}

const GltfField& fieldOf(const PropertyRow& row) {
  const std::string_view key = row.path.substr(row.path.rfind('/') + 1);
  return *std::ranges::find_if(gltfFields(),
                               [&](const GltfField& field) { return field.owner == row.owner && field.key == key; });
}

/// Finds the row, and which texture it belongs to.
const PropertyRow* findRow(std::string_view root, std::string_view path, std::size_t& texture) {
  if (root != kMaterials) return rowOf(root, path);
  for (std::size_t i = 0; i < std::size(kTextures); ++i) {
    const std::string_view start = kTextures[i].path;
    if (!path.starts_with(start) || !path.substr(start.size()).starts_with(kTransform)) continue;
    texture = i;
    return rowOf(kTransform, path.substr(start.size() + kTransform.size()));
  }
  return rowOf(root, path);
}

/// The property of one of `holders`, the elements of the array that `root` names.
template <class Holder>
std::optional<PropertyTarget> propertyBelow(const std::vector<Holder>& holders, std::string_view root,
                                            const std::string& pointer) {
  std::string_view path = std::string_view(pointer).substr(root.size());
  const std::size_t slash = std::min(path.find('/'), path.size());
  const auto index = indexIn(path.substr(0, slash), holders.size());
  if (!index || slash == path.size()) return std::nullopt;
  PropertyTarget target;
  const PropertyRow* row = findRow(root, path.substr(slash + 1), target.texture);
  if (row == nullptr) return std::nullopt;
  target.pointer = pointer;
  target.property = row->property;
  target.index = *index;
  Holder holder = holders[*index];
  target.components = numbersIn(holder, target).size();
  if (target.components == 0) return std::nullopt;
  const GltfField& field = fieldOf(*row);
  target.min = field.min;
  target.max = field.max;
  target.minExcluded = field.minExcluded;
  return target;
}

} // namespace

std::optional<PropertyTarget> propertyAt(const gltf::Model& model, const std::string& pointer) {
  if (pointer.starts_with(kMaterials)) return propertyBelow(model.materials, kMaterials, pointer);
  if (pointer.starts_with(kCameras)) return propertyBelow(model.cameras, kCameras, pointer);
  if (pointer.starts_with(kLights)) return propertyBelow(model.lights, kLights, pointer);
  return std::nullopt;
}

std::span<double> numbersOf(Properties& properties, const PropertyTarget& target) {
  if (target.property >= Property::lightColor) return numbersIn(properties.lights[target.index], target);
  if (target.property >= Property::yfov) return numbersIn(properties.cameras[target.index], target);
  return numbersIn(properties.materials[target.index], target);
}

std::optional<std::size_t> indexIn(std::string_view token, std::size_t size) {
  std::size_t index = 0;
  const char* end = token.data() + token.size();
  const auto read = std::from_chars(token.data(), end, index);
  const bool isIndex = read.ec == std::errc() && read.ptr == end && (token[0] != '0' || token.size() == 1);
  if (!isIndex || index >= size) return std::nullopt;
  return index;
}

} // namespace gnomon
