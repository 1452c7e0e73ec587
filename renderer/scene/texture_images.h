#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "renderer/scene/scene.h"

/// Which images drawing reads.
namespace gnomon {

/// True where holes of the material depend on its base color's texture.
bool readsAlpha(const Material& material);

/// Indices of the images that tell where there are holes in what the view places, in order, each once.
std::vector<int> alphaImages(const Scene& scene, const SceneView& view);

/// An image as the color space takes it in which a material reads it.
struct TextureImage {
  int image = 0; ///< index into Scene::images
  bool srgb = false;

  auto operator<=>(const TextureImage&) const = default;
};

/// A texture of a material, and the color space in which it is read.
struct TextureAsRead {
  const std::optional<TextureUse>* use = nullptr;
  bool srgb = false;
};

/// In the order in which shaders number them.
inline std::array<TextureAsRead, 5> texturesAsRead(const Material& material) {
  return {{{&material.baseColor, true},
           {&material.metallicRoughness, material.specularGlossiness.has_value()},
           {&material.normal, false},
           {&material.occlusion, false},
           {&material.emissive, true}}};
}

/// What these materials read, in order, each once. `materials`: indices into Scene::materials.
std::vector<TextureImage> textureImages(const Scene& scene, std::span<const int> materials);

} // namespace gnomon
