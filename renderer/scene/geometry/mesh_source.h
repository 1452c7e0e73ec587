#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "renderer/scene/decode/draco_primitives.h"
#include "renderer/scene/geometry/accessor_view.h"
#include "renderer/scene/materials/materials.h"
#include "renderer/scene/scene.h"

namespace gnomon {

struct PrimitiveSource;

/// The vertices and triangles of one primitive.
struct TriangleMesh {
  std::vector<glm::vec3> positions;
  std::vector<VertexAttributes> attributes; ///< parallel to positions
  std::vector<std::uint32_t> sources;       ///< parallel to positions: the vertex of the accessors that each one was
  std::vector<std::uint32_t> indices;       ///< three a triangle
  bool hasTangents = false;
  bool flat = false; ///< the file has no normals: each triangle has its own three vertices
};

/// Reads a primitive. Without normals it gets flat ones; normals and tangents that have no direction are replaced.
TriangleMesh buildVertices(const PrimitiveSource& source, Findings& findings);

/// Of a mesh or a node.
inline const Repair kOtherWeights{"The number of weights differs from the number of morph targets",
                                  "missing ones are 0, and those beyond are not used"};

/// What a morph target adds to each vertex. Absent attributes are nullptr.
struct MorphSource {
  const AccessorView* positions = nullptr;
  const AccessorView* normals = nullptr;
  const AccessorView* tangents = nullptr;
};

/// A primitive of the file whose accessors fit each other. Absent attributes are nullptr.
struct PrimitiveSource {
  std::string pointer;                           ///< its place in the glTF
  int material = -1;                             ///< -1 = the default material
  std::vector<int> variantMaterials{};           ///< as in Primitive
  PrimitiveMode mode = PrimitiveMode::triangles; ///< or a strip or fan of them
  const AccessorView* positions = nullptr;
  const AccessorView* normals = nullptr;
  const AccessorView* tangents = nullptr;
  std::array<const AccessorView*, 2> texCoords{}; ///< what uv0 and uv1 hold, by the materials' choice
  const AccessorView* colors = nullptr;
  double colorMost = 1; ///< what `colors` reads where a color is 1
  const AccessorView* indices = nullptr;
  std::vector<MorphSource> targets;
  std::array<const AccessorView*, 2> joints{}; ///< four joints a vertex each
  std::array<const AccessorView*, 2> weights{};

  /// Its vertices depend on a pose.
  bool deforms() const { return !targets.empty() || joints[0]; }
  std::size_t corners() const { return indices ? indices->count : positions->count; }
  std::size_t triangles() const;
};

/// The drawable primitives of each mesh, in the order of the file; refuses what would pass the limits before anything
/// is allocated. `uvSets`: one a material. The accessors and `draco` outlive the result.
std::vector<std::vector<PrimitiveSource>> gatherMeshes(const LoadContext& load, const DracoPrimitives& draco,
                                                       const std::vector<UvSets>& uvSets);

} // namespace gnomon
