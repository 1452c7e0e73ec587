#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "renderer/scene/geometry/mesh_source.h"

namespace gnomon {

class Findings;
struct LoadContext;
struct PrimitiveSource;

/// How much of a vertex follows which joints of a skin. The weights sum to 1; a weight of 0 is none.
struct Influences {
  std::array<std::uint16_t, 8> joints{};
  std::array<float, 8> weights{};
};

/// A vertex that a morph target moves, and by how much at a weight of 1.
struct MorphDelta {
  std::uint32_t vertex = 0;
  glm::vec3 position{0};
  glm::vec3 normal{0};
  glm::vec3 tangent{0};
};
using MorphTarget = std::vector<MorphDelta>;

/// A primitive whose vertices depend on the pose, as it is before morph targets and skin.
struct Deformable {
  TriangleMesh mesh;
  std::vector<MorphTarget> targets;
  std::vector<Influences> influences;  ///< parallel to the vertices; empty = no joints
  int greatestJoint = -1;              ///< that an influence with a weight names
  int material = 0;                    ///< index into Scene::materials
  std::vector<int> variantMaterials{}; ///< as in Primitive
};

struct Skin {
  std::vector<int> joints;               ///< nodes; none = it can't be read, and deforms nothing
  std::vector<glm::dmat4> jointFromMesh; ///< the inverse bind matrix of each
};

/// A primitive of the scene that was made from a deformable.
struct PosedPrimitive {
  int primitive = 0;           ///< index into Scene::primitives
  int deformable = 0;          ///< index into Deformation::deformables
  int node = 0;                ///< the first that has it
  int skin = -1;               ///< index into Deformation::skins; -1 = it follows its node
  std::vector<double> weights; ///< of the morph targets, at rest
};

/// What a scene's posed primitives are made from.
struct Deformation {
  std::vector<Deformable> deformables;
  std::vector<Skin> skins; ///< as the file numbers them
  std::vector<PosedPrimitive> posed;
};

/// Reads the morph targets and joints of a primitive whose vertices have been built.
Deformable buildDeformable(const PrimitiveSource& source, TriangleMesh mesh, Findings& findings);

/// The skins of the file, in its order; without joints where the inverse bind matrices can't be read.
std::vector<Skin> readSkins(const LoadContext& load);

} // namespace gnomon
