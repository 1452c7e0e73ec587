#pragma once

#include "renderer/scene/posing/pose.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// Gives a primitive the vertices of a pose, and what follows from them: bounds, clusters, welded indices, `solid`. Its
/// triangles keep their order.
void applyPose(const PosedShape& shape, int primitive, Scene& scene);

} // namespace gnomon
