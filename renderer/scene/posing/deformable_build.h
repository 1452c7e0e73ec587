#pragma once

#include "renderer/scene/geometry/mesh_source.h"
#include "renderer/scene/posing/deformation.h"

namespace gnomon {

/// Reads the morph targets and joints of a primitive whose vertices have been built.
Deformable buildDeformable(const PrimitiveSource& source, TriangleMesh mesh, Findings& findings);

} // namespace gnomon
