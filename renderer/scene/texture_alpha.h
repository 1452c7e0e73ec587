#pragma once

#include <glm/glm.hpp>

#include "renderer/scene/alpha_plane.h"
#include "renderer/scene/scene.h"

/// The alpha of a texture as OpenGL reads it.
namespace gnomon {

/// A place of a texture, and how it moves from a pixel to the one right of it and below.
struct TexturePlace {
  glm::dvec2 uv{0}, right{0}, below{0};
};

/// How often a texture of this size is halved until a texel is as large as a pixel; not more than 0, or not a number:
/// it is seen no smaller than it is.
double halvingsAt(const TexturePlace& place, const glm::ivec2& size);

/// 0..1, of the largest level.
double textureAlpha(const AlphaPlane& alpha, const TextureUse& use, const glm::dvec2& uv);

/// 0..1, of the levels that OpenGL reads there (4.5, 8.14 and 8.15).
double textureAlpha(const AlphaLevels& alpha, const TextureUse& use, const TexturePlace& place);

} // namespace gnomon
