#pragma once

#include <string>

#include "renderer/scene/geometry/mesh_source.h"

namespace gnomon {

/// SHA-256 of all that buildVertices() makes a mesh from: equal texts stand for equal meshes, whichever files they come
/// from. Empty where the vertices depend on a pose.
std::string meshContent(const PrimitiveSource& source);

} // namespace gnomon
