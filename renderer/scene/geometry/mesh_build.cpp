#include "renderer/scene/geometry/mesh_build.h"

#include <algorithm>
#include <meshoptimizer.h>
#include <numeric>
#include <span>

#include "renderer/scene/geometry/triangle_mesh.h"
#include "renderer/scene/posing/deformation.h"

namespace gnomon {

namespace {

void giveVertexColors(const PrimitiveSource& source, int material, std::vector<Material>& materials) {
  materials[static_cast<std::size_t>(material)].hasVertexColors = true;
  for (const int other : source.variantMaterials) {
    if (other >= 0) materials[static_cast<std::size_t>(other)].hasVertexColors = true;
  }
}

} // namespace

int appendPrimitive(const TriangleMesh& mesh, int material, Scene& scene) {
  const std::vector<Cluster> clusters = clustersOf(mesh.indices, mesh.positions);
  const std::vector<std::uint32_t> welded = weldedIndices(mesh.indices, mesh.positions);

  Primitive primitive;
  primitive.material = material;
  primitive.baseVertex = static_cast<std::uint32_t>(scene.positions.size());
  primitive.vertexCount = static_cast<std::uint32_t>(mesh.positions.size());
  primitive.firstIndex = static_cast<std::uint32_t>(scene.indices.size());
  primitive.indexCount = static_cast<std::uint32_t>(mesh.indices.size());
  primitive.firstCluster = static_cast<std::uint32_t>(scene.clusters.size());
  primitive.clusterCount = static_cast<std::uint32_t>(clusters.size());
  primitive.hasTangents = mesh.hasTangents;
  primitive.solid = boundsSolids(welded, mesh.positions);
  for (const Cluster& cluster : clusters) primitive.bounds.add(cluster.bounds);

  scene.positions.insert(scene.positions.end(), mesh.positions.begin(), mesh.positions.end());
  scene.attributes.insert(scene.attributes.end(), mesh.attributes.begin(), mesh.attributes.end());
  scene.indices.insert(scene.indices.end(), mesh.indices.begin(), mesh.indices.end());
  scene.welded.insert(scene.welded.end(), welded.begin(), welded.end());
  scene.clusters.insert(scene.clusters.end(), clusters.begin(), clusters.end());
  scene.primitives.push_back(primitive);
  return static_cast<int>(scene.primitives.size()) - 1;
}

std::vector<BuiltMesh> buildMeshes(const std::vector<std::vector<PrimitiveSource>>& meshes, int defaultMaterial,
                                   Scene& scene, std::vector<Deformable>& deformables, Findings& findings) {
  std::vector<BuiltMesh> built(meshes.size());
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    for (const PrimitiveSource& source : meshes[m]) {
      TriangleMesh mesh = ordered(buildVertices(source, findings));
      if (mesh.indices.empty()) continue;
      const int material = source.material >= 0 ? source.material : defaultMaterial;
      if (source.colors) giveVertexColors(source, material, scene.materials);
      if (source.deforms()) {
        built[m].deformables.push_back(static_cast<int>(deformables.size()));
        deformables.push_back(buildDeformable(source, std::move(mesh), findings));
        deformables.back().material = material;
        deformables.back().variantMaterials = source.variantMaterials;
      } else {
        built[m].primitives.push_back(appendPrimitive(mesh, material, scene));
        scene.primitives.back().variantMaterials = source.variantMaterials;
      }
    }
  }
  return built;
}

namespace {

/// Reorders the triangles of one cluster. Its vertices are numbered anew for that, so that the library's tables are as
/// small as the cluster.
void orderCluster(std::span<std::uint32_t> indices) {
  std::vector<std::uint32_t> vertices(indices.begin(), indices.end());
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  std::vector<std::uint32_t> local(indices.size());
  for (std::size_t i = 0; i < indices.size(); ++i) {
    local[i] =
        static_cast<std::uint32_t>(std::lower_bound(vertices.begin(), vertices.end(), indices[i]) - vertices.begin());
  }
  std::vector<std::uint32_t> sorted(local.size());
  meshopt_optimizeVertexCache(sorted.data(), local.data(), local.size(), vertices.size());
  for (std::size_t i = 0; i < indices.size(); ++i) indices[i] = vertices[sorted[i]];
}

template <class T>
std::vector<T> moved(const std::vector<T>& values, const std::vector<std::uint32_t>& newIndex) {
  std::vector<T> result(values.size());
  meshopt_remapVertexBuffer(result.data(), values.data(), values.size(), sizeof(T), newIndex.data());
  return result;
}

} // namespace

std::vector<std::uint32_t> spatiallySorted(std::vector<std::uint32_t> indices, std::span<const glm::vec3> positions) {
  if (indices.size() <= std::size_t{3} * kClusterTriangles) return indices;
  std::vector<std::uint32_t> sorted(indices.size());
  meshopt_spatialSortTriangles(sorted.data(), indices.data(), indices.size(), &positions.front().x, positions.size(),
                               sizeof(glm::vec3));
  return sorted;
}

std::vector<Cluster> clustersOf(std::span<const std::uint32_t> indices, std::span<const glm::vec3> positions) {
  constexpr std::size_t kCorners = std::size_t{3} * kClusterTriangles;
  std::vector<Cluster> clusters;
  for (std::size_t first = 0; first < indices.size(); first += kCorners) {
    Cluster cluster;
    for (const std::uint32_t vertex : indices.subspan(first, std::min(kCorners, indices.size() - first))) {
      cluster.bounds.add(glm::dvec3(positions[vertex]));
    }
    clusters.push_back(cluster);
  }
  return clusters;
}

TriangleMesh ordered(TriangleMesh mesh) {
  if (mesh.indices.empty()) return mesh;
  mesh.indices = spatiallySorted(std::move(mesh.indices), mesh.positions);
  constexpr std::size_t kCorners = std::size_t{3} * kClusterTriangles;
  for (std::size_t first = 0; first < mesh.indices.size(); first += kCorners) {
    orderCluster(std::span(mesh.indices).subspan(first, std::min(kCorners, mesh.indices.size() - first)));
  }
  // Every vertex is used by a triangle, so that none is lost.
  std::vector<std::uint32_t> newIndex(mesh.positions.size());
  meshopt_optimizeVertexFetchRemap(newIndex.data(), mesh.indices.data(), mesh.indices.size(), mesh.positions.size());
  meshopt_remapIndexBuffer(mesh.indices.data(), mesh.indices.data(), mesh.indices.size(), newIndex.data());
  mesh.positions = moved(mesh.positions, newIndex);
  mesh.attributes = moved(mesh.attributes, newIndex);
  mesh.sources = moved(mesh.sources, newIndex);
  return mesh;
}

namespace {

/// Steele et al., "Fast Splittable Pseudorandom Number Generators", 2014: the finalizer of SplitMix64.
std::uint64_t mixed(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

std::uint64_t edgeHash(std::uint32_t from, std::uint32_t to) {
  return mixed(((std::uint64_t{from} << 32) | to) + 0x9e3779b97f4a7c15u);
}

/// Edges walked from a to b count for, from b to a against: the sum of their hashes is 0 where all cancel out, and
/// elsewhere with a chance of 2^-64.
bool edgesCancel(std::span<const std::uint32_t> welded) {
  std::uint64_t sum = 0;
  for (std::size_t t = 0; t < welded.size(); t += 3) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t from = welded[t + corner];
      const std::uint32_t to = welded[t + (corner + 1) % 3];
      if (from == to) continue;
      sum += from < to ? edgeHash(from, to) : std::uint64_t{0} - edgeHash(to, from);
    }
  }
  return sum == 0;
}

/// Disjoint sets of vertices, each named by its lowest (path halving: Tarjan and van Leeuwen, 1984).
class Pieces {
 public:
  explicit Pieces(std::size_t vertices) : parent_(vertices) { std::iota(parent_.begin(), parent_.end(), 0u); }

  std::uint32_t of(std::uint32_t vertex) {
    while (parent_[vertex] != vertex) vertex = parent_[vertex] = parent_[parent_[vertex]];
    return vertex;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    const std::uint32_t rootA = of(a);
    const std::uint32_t rootB = of(b);
    parent_[std::max(rootA, rootB)] = std::min(rootA, rootB);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

} // namespace

std::vector<std::uint32_t> weldedIndices(std::span<const std::uint32_t> indices, std::span<const glm::vec3> positions) {
  std::vector<std::uint32_t> welded(indices.size());
  if (indices.empty()) return welded; // the library wants a list
  meshopt_generateShadowIndexBuffer(welded.data(), indices.data(), indices.size(), positions.data(), positions.size(),
                                    sizeof(glm::vec3), sizeof(glm::vec3));
  return welded;
}

bool boundsSolids(std::span<const std::uint32_t> welded, std::span<const glm::vec3> positions) {
  if (welded.empty() || !edgesCancel(welded)) return false;
  Pieces pieces(positions.size());
  for (std::size_t t = 0; t < welded.size(); t += 3) {
    pieces.join(welded[t], welded[t + 1]);
    pieces.join(welded[t], welded[t + 2]);
  }
  // Volumes are measured from a vertex of the piece, so that a place far from the origin costs no digits.
  std::vector<double> volumes(positions.size());
  for (std::size_t t = 0; t < welded.size(); t += 3) {
    const std::uint32_t piece = pieces.of(welded[t]);
    const glm::dvec3 origin(positions[piece]);
    const glm::dvec3 a = glm::dvec3(positions[welded[t]]) - origin;
    const glm::dvec3 b = glm::dvec3(positions[welded[t + 1]]) - origin;
    const glm::dvec3 c = glm::dvec3(positions[welded[t + 2]]) - origin;
    volumes[piece] += glm::dot(a, glm::cross(b, c));
  }
  return std::all_of(volumes.begin(), volumes.end(), [](double volume) { return volume >= 0; });
}

} // namespace gnomon
