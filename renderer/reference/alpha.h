#pragma once

#include "renderer/reference/traced_scene.h"
#include "renderer/reference/triangle.h"

namespace gnomon {

/// Alpha of the surface there, as the shaders find it: factor, vertex colour, and texture, filtered at its base level.
/// Any material; opaque ones ignore it.
double alphaAt(const TracedScene::Tree& tree, std::uint32_t instance, std::uint32_t triangle, const Barycentric& at);

/// 0..1, at a place of the texture.
double textureAlpha(const AlphaPlane& alpha, const TextureUse& use, const glm::dvec2& uv);

} // namespace gnomon
