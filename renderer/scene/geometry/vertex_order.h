#pragma once

#include "renderer/scene/geometry/triangle_mesh.h"

namespace gnomon {

/// The same triangles in the order that a device draws fast: clusters of triangles that lie near each other, those of a
/// cluster one after the other as their vertices are shared, and vertices as they are first used. The result depends on
/// nothing but the mesh.
TriangleMesh ordered(TriangleMesh mesh);

} // namespace gnomon
