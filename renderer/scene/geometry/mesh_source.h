#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "renderer/scene/decode/draco_primitives.h"
#include "renderer/scene/geometry/accessor_view.h"
#include "renderer/scene/materials/uv_sets.h"

namespace gnomon {

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

/// What is drawn of each mesh, in the order of the file; primitives that are not drawn are left out with a warning, as
/// are attributes that do not hold what they should.
/// Refuses before anything is allocated when the whole would pass the limits. `uvSets`: one a material. The
/// accessors and `draco` must outlive the result.
std::vector<std::vector<PrimitiveSource>> gatherMeshes(const LoadContext& load, const DracoPrimitives& draco,
                                                       const std::vector<UvSets>& uvSets);

} // namespace gnomon
