#pragma once

#include <memory>

#include "renderer/scene/scene.h"

namespace gnomon {

/// Puts a square of one metre behind the scene's vertices and indices, so that a ground takes no copy of them.
void addGroundMesh(Scene& scene);

/// A pose with a ground in each of its views; shares vertices and images. REQUIRES: it has none.
std::shared_ptr<const Scene> groundedScene(const Scene& posed, const GroundPlane& ground);

} // namespace gnomon
