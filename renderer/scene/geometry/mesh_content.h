#pragma once

#include <map>
#include <string>

#include "renderer/scene/geometry/mesh_source.h"

namespace gnomon {

/// The contents of a file's primitives. An accessor is read once, however many of them use it.
class MeshContents {
 public:
  /// SHA-256 of all that buildVertices() makes a mesh from: equal texts stand for equal meshes, whichever files they
  /// come from. Empty where the vertices depend on a pose. The views outlive this.
  std::string of(const PrimitiveSource& source);

 private:
  std::map<const AccessorView*, std::string> accessors_; ///< SHA-256 of those that were read
};

} // namespace gnomon
