#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "protocol/spec/scene_options.h"
#include "renderer/core/aabb.h"
#include "renderer/scene/geometry/welding.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// The edges and faces of a primitive, from which its outline follows.
struct EdgeMesh {
  std::vector<MeshEdge> edges;
  std::vector<glm::vec3> normals; ///< one a triangle, in the primitive's own space, unit length; 0 where it has no area
  std::vector<Aabb> pieces;       ///< of a solid (Primitive::solid), the box of each connected piece, in its own space
  std::vector<std::uint32_t> pieceOf; ///< of a solid, one a triangle: index into `pieces`
};

/// One a primitive of the scene.
std::vector<EdgeMesh> edgeMeshes(const Scene& scene);

std::size_t bytesOf(const std::vector<EdgeMesh>& meshes);

/// Where a light stands in the world: a place and 1, or for a directional light the unit direction towards it and 0.
glm::dvec4 placeOf(const Light& light);

/// How each triangle of a primitive, placed in the world, is turned to a light: 1 = seen from there its corners go
/// round against the clock, -1 = with it, 0 = edge-on. Exact to the rounding of doubles, whatever the matrix (sheared,
/// mirrored, of scale 0): for a directional light, edge-on is what lies within 1e-12 of the light's way, for others
/// what they see under an elevation of at most 1e-6, since floats tell the two sides of such a plane apart no more.
std::vector<std::int8_t> facings(const Scene& scene, const Primitive& primitive, const glm::dmat4& worldFromLocal,
                                 const glm::dvec4& light);

/// An edge along which a shadow begins or ends. Seen from the light, what throws it lies to the left.
struct SilhouetteEdge {
  std::uint32_t from = 0; ///< as in MeshEdge
  std::uint32_t to = 0;

  bool operator==(const SilhouetteEdge&) const = default;
};

/// The outline, seen from the light, of the triangles that throw a shadow. `turns`, one a triangle: 1 or -1 = it is one
/// of them and turned that way (facings); 0 = it is none. Where two of them fold over an edge, it is there twice; where
/// one goes on from the other, not at all.
std::vector<SilhouetteEdge> silhouette(std::span<const MeshEdge> edges, std::span<const std::int8_t> turns);

} // namespace gnomon
