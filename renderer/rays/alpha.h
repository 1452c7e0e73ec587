#pragma once

#include "renderer/rays/traced_scene.h"
#include "renderer/rays/triangle.h"

namespace gnomon {

/// Alpha of the surface there: factor, vertex color and texture, of which the light reads the largest level.
/// REQUIRES: hasHoles().
double alphaAt(const TracedScene::Tree& tree, std::uint32_t instance, std::uint32_t triangle, const Barycentric& at);

/// A place in a triangle, and what a picture's pixels right of it and below show of the triangle's plane.
struct SeenPlace {
  Barycentric at, right, below;
};

/// Whether a picture shows the surface of a material with holes there, and not a hole in it: of a texture it reads the
/// level whose texels are as large as pixels, of which as much shows as of the texture (MaskCoverage).
bool isFilled(const TracedScene::Tree& tree, std::uint32_t instance, std::uint32_t triangle, const SeenPlace& place);

} // namespace gnomon
