#include "renderer/scene/geometry/clusters.h"

#include <algorithm>
#include <meshoptimizer.h>

namespace gnomon {

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

} // namespace gnomon
