#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "renderer/scene/decode/draco_stream.h"
#include "renderer/scene/document/gltf_document.h"
#include "renderer/scene/findings.h"
#include "renderer/scene/geometry/accessor_view.h"

namespace draco {
class Mesh;
}
namespace gnomon {

/// What KHR_draco_mesh_compression holds of a primitive, as if its accessors had it.
struct DracoPrimitive {
  std::map<std::string, AccessorView> attributes; ///< by their names in the primitive
  AccessorView indices;                           ///< a triangle list
  DracoMesh mesh;                                 ///< what the views read; several may read one of its attributes
};

/// By the number of the mesh and of the primitive in it.
using DracoPrimitives = std::map<std::pair<std::size_t, std::size_t>, DracoPrimitive>;

/// Decodes every compressed primitive; one that can't be decoded is left out, with a repair. An attribute that the data
/// lack is a kFaultyAccessor.
DracoPrimitives decodeDracoPrimitives(const LoadContext& load);

/// Triangles and the attributes `wanted` of a decoded mesh, without those that are none that a glTF may have; nothing,
/// and a problem, where an index lies outside of it.
std::optional<DracoMesh> keptMesh(const draco::Mesh& mesh, const std::set<std::uint32_t>& wanted,
                                  const std::string& pointer, Findings& findings);

} // namespace gnomon
