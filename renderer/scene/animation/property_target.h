#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "renderer/scene/document/gltf_model.h"

namespace gnomon {

/// The numbers of a property in what it belongs to; empty where the object that it stands in is missing.
template <class Holder>
using NumbersIn = std::span<double> (*)(Holder&);

/// What KHR_animation_pointer moves of a material, camera or light, found in a file.
struct PropertyTarget {
  std::string pointer; ///< into the file's JSON (RFC 6901)
  std::variant<NumbersIn<gltf::Material>, NumbersIn<gltf::TextureTransform>, NumbersIn<gltf::Camera>,
               NumbersIn<gltf::PunctualLight>>
      numbers{};
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
