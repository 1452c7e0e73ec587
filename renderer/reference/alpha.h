#pragma once

#include "renderer/reference/traced_scene.h"
#include "renderer/reference/triangle.h"

namespace gnomon {

/// Alpha of the surface there: factor, vertex color and texture, of which the light reads the largest level. Any
/// material; opaque ones ignore it.
double alphaAt(const TracedScene::Tree& tree, std::uint32_t instance, std::uint32_t triangle, const Barycentric& at);

/// A place in a triangle, and what a picture's pixels right of it and below show of the triangle's plane.
struct SeenPlace {
  Barycentric at, right, below;
};

/// The same as a picture shows it: of a texture the level whose texels are as large as pixels.
double alphaSeen(const TracedScene::Tree& tree, std::uint32_t instance, std::uint32_t triangle, const SeenPlace& place);

/// A place of a texture, and how it moves from a pixel to the one right of it and below.
struct TexturePlace {
  glm::dvec2 uv{0}, right{0}, below{0};
};

/// 0..1, of the largest level.
double textureAlpha(const AlphaPlane& alpha, const TextureUse& use, const glm::dvec2& uv);

/// 0..1, of the levels that OpenGL reads there (4.5, 8.14 and 8.15).
double textureAlpha(const AlphaLevels& alpha, const TextureUse& use, const TexturePlace& place);

} // namespace gnomon
