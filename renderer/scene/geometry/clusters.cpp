#include "renderer/scene/geometry/clusters.h"

#include <algorithm>
#include <meshoptimizer.h>
#include <span>

namespace gnomon {

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

} // namespace gnomon
