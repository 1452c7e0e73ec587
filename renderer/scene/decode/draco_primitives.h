#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "protocol/base/bytes.h"
#include "protocol/spec/limits.h"
#include "renderer/scene/container/resources.h"
#include "renderer/scene/document/gltf_document.h"
#include "renderer/scene/findings.h"
#include "renderer/scene/geometry/accessor_view.h"

namespace gnomon {

/// What the accessors of a glTF say that a Draco stream holds.
struct DracoClaims {
  std::uint64_t points = 0;
  std::optional<std::uint64_t> triangles; ///< nothing where the glTF does not say
};

/// One value a point, packed.
struct DracoAttribute {
  ComponentType type = ComponentType::float32;
  int components = 0; ///< 1..4
  Bytes bytes;
};

struct DracoMesh {
  std::uint32_t points = 0;
  std::vector<std::uint32_t> corners;                 ///< three a triangle, below the number of points
  std::map<std::uint32_t, DracoAttribute> attributes; ///< by the id within the stream
};

/// Decodes a Draco bitstream 2.2 and keeps the attributes `wanted`. Stated numbers are checked against claims, limits
/// and budget before memory is allocated. Nothing, and a problem at `pointer`, on failure; other numbers of triangles
/// and points than claimed are a repair.
std::optional<DracoMesh> decodeDraco(std::span<const std::uint8_t> stream, const DracoClaims& claims,
                                     const std::set<std::uint32_t>& wanted, const Limits& limits, DecodeBudget& budget,
                                     const std::string& pointer, Findings& findings);

/// What KHR_draco_mesh_compression holds of a primitive, as if its accessors had it.
struct DracoPrimitive {
  std::map<std::string, AccessorView> attributes; ///< by their names in the primitive
  AccessorView indices;                           ///< a triangle list
  DracoMesh mesh;                                 ///< what the views read; several may read one of its attributes
};

/// By the number of the mesh and of the primitive in it.
using DracoPrimitives = std::map<std::pair<std::size_t, std::size_t>, DracoPrimitive>;

/// Decodes every compressed primitive, or leaves it out with a repair; a missing attribute is a kFaultyAccessor.
DracoPrimitives decodeDracoPrimitives(const LoadContext& load);

} // namespace gnomon
