#include "renderer/passes/stencil/stencil_outlines.h"

#include <algorithm>
#include <numeric>

#include "protocol/spec/traits.h"
#include "renderer/core/light.h"
#include "renderer/core/linear_algebra.h"
#include "renderer/scene/geometry/welding.h"

namespace gnomon {
namespace {

glm::vec3 normalOf(const Scene& scene, const Primitive& primitive, std::uint32_t triangle) {
  const auto corner = [&](std::uint32_t i) {
    return glm::dvec3(scene.positions[primitive.baseVertex + scene.indices[primitive.firstIndex + 3 * triangle + i]]);
  };
  const glm::dvec3 area = glm::cross(corner(1) - corner(0), corner(2) - corner(0));
  const double length = glm::length(area);
  return length > 0 ? glm::vec3(area / length) : glm::vec3(0.0f);
}

void addPieces(const Scene& scene, const Primitive& primitive, EdgeMesh& mesh) {
  constexpr std::uint32_t kNone = ~0u;
  const auto welded = std::span(scene.welded).subspan(primitive.firstIndex, primitive.indexCount);
  const std::vector<std::uint32_t> named = piecesOfVertices(welded, primitive.vertexCount);
  std::vector<std::uint32_t> numbers(primitive.vertexCount, kNone);
  mesh.pieceOf.resize(welded.size() / 3);
  for (std::size_t t = 0; t < mesh.pieceOf.size(); ++t) {
    std::uint32_t& number = numbers[named[welded[3 * t]]];
    if (number == kNone) {
      number = static_cast<std::uint32_t>(mesh.pieces.size());
      mesh.pieces.emplace_back();
    }
    mesh.pieceOf[t] = number;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      mesh.pieces[number].add(glm::dvec3(scene.positions[primitive.baseVertex + welded[3 * t + corner]]));
    }
  }
}

} // namespace

std::vector<EdgeMesh> edgeMeshes(const Scene& scene) {
  std::vector<EdgeMesh> meshes(scene.primitives.size());
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const Primitive& primitive = scene.primitives[i];
    meshes[i].edges = meshEdges(scene, primitive);
    meshes[i].normals.resize(primitive.indexCount / 3);
    for (std::uint32_t triangle = 0; triangle < meshes[i].normals.size(); ++triangle) {
      meshes[i].normals[triangle] = normalOf(scene, primitive, triangle);
    }
    if (primitive.solid) addPieces(scene, primitive, meshes[i]);
  }
  return meshes;
}

std::size_t bytesOf(const std::vector<EdgeMesh>& meshes) {
  return std::accumulate(meshes.begin(), meshes.end(), std::size_t{0}, [](std::size_t sum, const EdgeMesh& mesh) {
    return sum + mesh.edges.size() * sizeof(MeshEdge) + mesh.normals.size() * sizeof(glm::vec3) +
           mesh.pieces.size() * sizeof(Aabb) + mesh.pieceOf.size() * sizeof(std::uint32_t);
  });
}

glm::dvec4 placeOf(const Light& light) {
  if (traitsOf(light.type).parallel) return {-directionOf(light), 0.0};
  return {toVector(*light.position), 1.0};
}

std::vector<std::int8_t> facings(const Scene& scene, const Primitive& primitive, const glm::dmat4& worldFromLocal,
                                 const glm::dvec4& light) {
  // The primitive turned and scaled but not moved, so that a place far from the origin costs no digits.
  const glm::dmat3 linear(worldFromLocal);
  std::vector<glm::dvec3> turned(primitive.vertexCount);
  const auto positions = scene.positions.begin() + static_cast<std::ptrdiff_t>(primitive.baseVertex);
  std::transform(positions, positions + static_cast<std::ptrdiff_t>(primitive.vertexCount), turned.begin(),
                 [&](const glm::vec3& position) { return linear * glm::dvec3(position); });
  const glm::dvec3 towards = glm::dvec3(light) - light.w * glm::dvec3(worldFromLocal[3]);
  const double edgeOn = light.w == 0 ? 1e-12 : 1e-6;

  std::vector<std::int8_t> signs(primitive.indexCount / 3);
  for (std::size_t t = 0; t < signs.size(); ++t) {
    const std::uint32_t* corners = &scene.welded[primitive.firstIndex + 3 * t];
    const glm::dvec3& origin = turned[corners[0]];
    const glm::dvec3 first = turned[corners[1]] - origin;
    const glm::dvec3 second = turned[corners[2]] - origin;
    const glm::dvec3 normal = glm::cross(first, second);
    const glm::dvec3 toLight = towards - light.w * origin;
    const double height = glm::dot(normal, toLight);
    // A corner is off by a rounding of its distance from the primitive's origin, the normal by as much times the sides.
    const double sides = glm::length(first) + glm::length(second);
    constexpr double kRounding = 1e-15;
    const double noise = kRounding * sides * (glm::length(origin) + sides);
    const double least = (edgeOn * glm::length(normal) + noise) * glm::length(toLight);
    signs[t] = static_cast<std::int8_t>(height > least ? 1 : height < -least ? -1 : 0);
  }
  return signs;
}

std::vector<SilhouetteEdge> silhouette(std::span<const MeshEdge> edges, std::span<const std::int8_t> turns) {
  std::vector<SilhouetteEdge> outline;
  for (const MeshEdge& edge : edges) {
    const int times = turns[edge.left] - (edge.right == kNoTriangle ? 0 : turns[edge.right]);
    for (int i = 0; i < times; ++i) outline.push_back({edge.from, edge.to});
    for (int i = 0; i > times; --i) outline.push_back({edge.to, edge.from});
  }
  return outline;
}

} // namespace gnomon
