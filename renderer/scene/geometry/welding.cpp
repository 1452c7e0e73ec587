#include "renderer/scene/geometry/welding.h"

#include <algorithm>
#include <meshoptimizer.h>
#include <numeric>

#include "protocol/base/split_mix.h"

namespace gnomon {

namespace {

std::uint64_t edgeHash(std::uint32_t from, std::uint32_t to) {
  return splitMix64((std::uint64_t{from} << 32) | to);
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

std::vector<std::uint32_t> piecesOfVertices(std::span<const std::uint32_t> welded, std::size_t vertexCount) {
  Pieces pieces(vertexCount);
  for (std::size_t t = 0; t < welded.size(); t += 3) {
    pieces.join(welded[t], welded[t + 1]);
    pieces.join(welded[t], welded[t + 2]);
  }
  std::vector<std::uint32_t> named(vertexCount);
  for (std::uint32_t vertex = 0; vertex < vertexCount; ++vertex) named[vertex] = pieces.of(vertex);
  return named;
}

bool boundsSolids(std::span<const std::uint32_t> welded, std::span<const glm::vec3> positions) {
  if (welded.empty() || !edgesCancel(welded)) return false;
  const std::vector<std::uint32_t> pieces = piecesOfVertices(welded, positions.size());
  // Volumes are measured from a vertex of the piece, so that a place far from the origin costs no digits.
  std::vector<double> volumes(positions.size());
  for (std::size_t t = 0; t < welded.size(); t += 3) {
    const std::uint32_t piece = pieces[welded[t]];
    const glm::dvec3 origin(positions[piece]);
    const glm::dvec3 a = glm::dvec3(positions[welded[t]]) - origin;
    const glm::dvec3 b = glm::dvec3(positions[welded[t + 1]]) - origin;
    const glm::dvec3 c = glm::dvec3(positions[welded[t + 2]]) - origin;
    volumes[piece] += glm::dot(a, glm::cross(b, c));
  }
  return std::all_of(volumes.begin(), volumes.end(), [](double volume) { return volume >= 0; });
}

} // namespace gnomon
