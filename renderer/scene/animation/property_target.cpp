#include <algorithm>
#include <charconv>

#include "renderer/scene/animation/motion.h"
#include "renderer/scene/checks/gltf_fields.h"

namespace gnomon {

namespace {

constexpr std::string_view kMaterials = "/materials/";
constexpr std::string_view kCameras = "/cameras/";
constexpr std::string_view kLights = "/extensions/KHR_lights_punctual/lights/";
constexpr std::string_view kTransform = "/extensions/KHR_texture_transform/";

std::span<double> spanOf(double& value) {
  return {&value, 1};
}
template <int kSize>
std::span<double> spanOf(glm::vec<kSize, double>& value) {
  return {&value[0], std::size_t{kSize}};
}
/// A number of an object that may be missing.
template <class Object, class Number>
std::span<double> spanIn(std::optional<Object>& object, Number Object::*number) {
  return object ? spanOf((*object).*number) : std::span<double>();
}

/// Where a property stands below what it belongs to, and the owner of its row in gltfFields(), which says its range.
template <class Holder>
struct PropertyRow {
  std::string_view path;
  std::string_view owner;
  NumbersIn<Holder> numbers;
};

using gltf::Camera, gltf::Material, gltf::OrthographicLens, gltf::PerspectiveLens, gltf::PunctualLight;
using gltf::SpecularGlossiness, gltf::SpotCone, gltf::TextureTransform, gltf::Transmission;

constexpr PropertyRow<Material> kMaterialRows[] = {
    {"pbrMetallicRoughness/baseColorFactor", "pbr", [](Material& m) { return spanOf(m.baseColorFactor); }},
    {"pbrMetallicRoughness/metallicFactor", "pbr", [](Material& m) { return spanOf(m.metallicFactor); }},
    {"pbrMetallicRoughness/roughnessFactor", "pbr", [](Material& m) { return spanOf(m.roughnessFactor); }},
    {"normalTexture/scale", "normalTexture",
     [](Material& m) { return m.normalTexture ? spanOf(m.normalScale) : std::span<double>(); }},
    {"occlusionTexture/strength", "occlusionTexture",
     [](Material& m) { return m.occlusionTexture ? spanOf(m.occlusionStrength) : std::span<double>(); }},
    {"emissiveFactor", "material", [](Material& m) { return spanOf(m.emissiveFactor); }},
    {"extensions/KHR_materials_emissive_strength/emissiveStrength", "emissiveStrength",
     [](Material& m) { return m.emissiveStrength ? spanOf(*m.emissiveStrength) : std::span<double>(); }},
    {"alphaCutoff", "material", [](Material& m) { return spanOf(m.alphaCutoff); }},
    {"extensions/KHR_materials_transmission/transmissionFactor", "transmission",
     [](Material& m) { return spanIn(m.transmission, &Transmission::factor); }},
    {"extensions/KHR_materials_pbrSpecularGlossiness/diffuseFactor", "specularGlossiness",
     [](Material& m) { return spanIn(m.specularGlossiness, &SpecularGlossiness::diffuseFactor); }},
    {"extensions/KHR_materials_pbrSpecularGlossiness/specularFactor", "specularGlossiness",
     [](Material& m) { return spanIn(m.specularGlossiness, &SpecularGlossiness::specularFactor); }},
    {"extensions/KHR_materials_pbrSpecularGlossiness/glossinessFactor", "specularGlossiness",
     [](Material& m) { return spanIn(m.specularGlossiness, &SpecularGlossiness::glossinessFactor); }},
};

constexpr PropertyRow<TextureTransform> kTransformRows[] = {
    {"offset", "textureTransform", [](TextureTransform& t) { return spanOf(t.offset); }},
    {"rotation", "textureTransform", [](TextureTransform& t) { return spanOf(t.rotation); }},
    {"scale", "textureTransform", [](TextureTransform& t) { return spanOf(t.scale); }},
};

constexpr PropertyRow<Camera> kCameraRows[] = {
    {"perspective/yfov", "perspective", [](Camera& c) { return spanIn(c.perspective, &PerspectiveLens::yfov); }},
    {"perspective/znear", "perspective", [](Camera& c) { return spanIn(c.perspective, &PerspectiveLens::znear); }},
    {"perspective/zfar", "perspective", [](Camera& c) { return spanIn(c.perspective, &PerspectiveLens::zfar); }},
    {"orthographic/ymag", "orthographic", [](Camera& c) { return spanIn(c.orthographic, &OrthographicLens::ymag); }},
    {"orthographic/znear", "orthographic", [](Camera& c) { return spanIn(c.orthographic, &OrthographicLens::znear); }},
    {"orthographic/zfar", "orthographic", [](Camera& c) { return spanIn(c.orthographic, &OrthographicLens::zfar); }},
};

constexpr PropertyRow<PunctualLight> kLightRows[] = {
    {"color", "light",
     [](PunctualLight& l) {
       if (!l.color) l.color = glm::dvec3(1);
       return spanOf(*l.color);
     }},
    {"intensity", "light", [](PunctualLight& l) { return spanOf(l.intensity); }},
    {"range", "light", [](PunctualLight& l) { return spanOf(l.range); }},
    {"spot/innerConeAngle", "spot", [](PunctualLight& l) { return spanIn(l.spot, &SpotCone::inner); }},
    {"spot/outerConeAngle", "spot", [](PunctualLight& l) { return spanIn(l.spot, &SpotCone::outer); }},
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

/// nullptr where the material has no such texture, or nothing moves it.
TextureTransform* transformIn(Material& material, std::size_t texture) {
  auto* info = kTextures[texture].in(material);
  return info && *info && (*info)->transform ? &*(*info)->transform : nullptr;
}

/// Fills the target from the row of that path; false where there is none, or no number in `holder`.
template <class Holder, std::size_t kCount>
bool fillFrom(const PropertyRow<Holder> (&rows)[kCount], std::string_view path, Holder& holder,
              PropertyTarget& target) {
  const auto* row = std::ranges::find(rows, path, &PropertyRow<Holder>::path);
  if (row == std::end(rows)) return false;
  const std::string_view key = path.substr(path.rfind('/') + 1);
  const GltfField& field = *std::ranges::find_if(
      gltfFields(), [&](const GltfField& each) { return each.owner == row->owner && each.key == key; });
  target.numbers = row->numbers;
  target.components = row->numbers(holder).size();
  target.min = field.min;
  target.max = field.max;
  target.minExcluded = field.minExcluded;
  return target.components > 0;
}

bool fill(std::string_view path, Material& material, PropertyTarget& target) {
  for (target.texture = 0; target.texture < std::size(kTextures); ++target.texture) {
    const std::string_view start = kTextures[target.texture].path;
    if (!path.starts_with(start) || !path.substr(start.size()).starts_with(kTransform)) continue;
    auto* transform = transformIn(material, target.texture);
    return transform && fillFrom(kTransformRows, path.substr(start.size() + kTransform.size()), *transform, target);
  }
  return fillFrom(kMaterialRows, path, material, target);
}
bool fill(std::string_view path, Camera& camera, PropertyTarget& target) {
  return fillFrom(kCameraRows, path, camera, target);
}
bool fill(std::string_view path, PunctualLight& light, PropertyTarget& target) {
  return fillFrom(kLightRows, path, light, target);
}

/// The property of one of `holders`, the elements of the array that `root` names.
template <class Holder>
std::optional<PropertyTarget> propertyBelow(const std::vector<Holder>& holders, std::string_view root,
                                            const std::string& pointer) {
  const std::string_view path = std::string_view(pointer).substr(root.size());
  const std::size_t slash = std::min(path.find('/'), path.size());
  const auto index = indexIn(path.substr(0, slash), holders.size());
  if (!index || slash == path.size()) return std::nullopt;
  PropertyTarget target{.pointer = pointer, .index = *index};
  Holder holder = holders[*index];
  return fill(path.substr(slash + 1), holder, target) ? std::optional(target) : std::nullopt;
}

} // namespace

std::optional<PropertyTarget> propertyAt(const gltf::Model& model, const std::string& pointer) {
  if (pointer.starts_with(kMaterials)) return propertyBelow(model.materials, kMaterials, pointer);
  if (pointer.starts_with(kCameras)) return propertyBelow(model.cameras, kCameras, pointer);
  if (pointer.starts_with(kLights)) return propertyBelow(model.lights, kLights, pointer);
  return std::nullopt;
}

std::span<double> numbersOf(Properties& properties, const PropertyTarget& target) {
  struct Finder {
    Properties& properties;
    const PropertyTarget& target;

    std::span<double> operator()(NumbersIn<gltf::Material> numbers) const {
      return numbers(properties.materials[target.index]);
    }
    std::span<double> operator()(NumbersIn<gltf::TextureTransform> numbers) const {
      return numbers(*transformIn(properties.materials[target.index], target.texture));
    }
    std::span<double> operator()(NumbersIn<gltf::Camera> numbers) const {
      return numbers(properties.cameras[target.index]);
    }
    std::span<double> operator()(NumbersIn<gltf::PunctualLight> numbers) const {
      return numbers(properties.lights[target.index]);
    }
  };
  return std::visit(Finder{properties, target}, target.numbers);
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
