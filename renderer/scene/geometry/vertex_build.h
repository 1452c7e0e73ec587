#pragma once

#include "renderer/scene/geometry/mesh_source.h"
#include "renderer/scene/geometry/triangle_mesh.h"

namespace gnomon {

/// Reads a primitive. Without normals it gets flat ones; normals and tangents that have no direction are replaced.
TriangleMesh buildVertices(const PrimitiveSource& source, Findings& findings);

} // namespace gnomon
