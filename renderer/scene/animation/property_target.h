#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/scene/document/gltf_model.h"

namespace gnomon {

/// What KHR_animation_pointer moves of a material, camera or light.
enum class Property {
  baseColorFactor,
  metallicFactor,
  roughnessFactor,
  normalScale,
  occlusionStrength,
  emissiveFactor,
  emissiveStrength,
  alphaCutoff,
  transmissionFactor,
  diffuseFactor,
  specularFactor,
  glossinessFactor,
  textureOffset,
  textureRotation,
  textureScale,
  yfov,
  perspectiveNear,
  perspectiveFar,
  ymag,
  orthographicNear,
  orthographicFar,
  lightColor,
  lightIntensity,
  lightRange,
  innerCone,
  outerCone
};

/// One of them, found in a file.
struct PropertyTarget {
  std::string pointer; ///< into the file's JSON (RFC 6901)
  Property property = Property::baseColorFactor;
  std::size_t index = 0;                                 ///< of the material, camera or light
  std::size_t texture = 0;                               ///< of a texture's transform: which of the material's textures
  std::size_t components = 1;                            ///< 1 to 4
  double min = -std::numeric_limits<double>::infinity(); ///< what glTF allows of each number
  double max = std::numeric_limits<double>::infinity();
  bool minExcluded = false;
};

/// The parts of a file that properties lie in.
struct Properties {
  std::vector<gltf::Material> materials;
  std::vector<gltf::Camera> cameras;
  std::vector<gltf::PunctualLight> lights;
};

/// What a pointer names; nothing where it names no number that is drawn by. An object that the file does not have can't
/// be pointed into, but for a material's pbrMetallicRoughness, which has a default for each member.
std::optional<PropertyTarget> propertyAt(const gltf::Model& model, const std::string& pointer);

/// The numbers of a target that was found in these.
std::span<double> numbersOf(Properties& properties, const PropertyTarget& target);

/// A token of a JSON pointer as an index below `size`; it has no sign and no leading zero (RFC 6901).
std::optional<std::size_t> indexIn(std::string_view token, std::size_t size);

} // namespace gnomon
