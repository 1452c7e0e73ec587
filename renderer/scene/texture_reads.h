#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "renderer/scene/scene.h"
#include "renderer/scene/scene_image.h"

/// Which images drawing reads.
namespace gnomon {

/// True where holes of the material depend on its base color's texture.
bool readsAlpha(const Material& material);

/// Indices of the images whose alpha makes holes in what the view places, in order, each once.
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

// The alpha of a texture as OpenGL reads it.

/// A place of a texture, and how it moves from a pixel to the one right of it and below.
struct TexturePlace {
  glm::dvec2 uv{0}, right{0}, below{0};
};

/// How often a texture of this size is halved until a texel is as large as a pixel; <= 0 or NaN: it is not seen
/// smaller.
double halvingsAt(const TexturePlace& place, const glm::ivec2& size);

/// 0..1, of the largest level.
double textureAlpha(const AlphaPlane& alpha, const TextureUse& use, const glm::dvec2& uv);

/// 0..1, of the levels that OpenGL reads there (4.5, 8.14 and 8.15).
double textureAlpha(const AlphaLevels& alpha, const TextureUse& use, const TexturePlace& place);

} // namespace gnomon
