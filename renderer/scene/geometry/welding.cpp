#include "renderer/scene/geometry/welding.h"

#include <algorithm>
#include <meshoptimizer.h>
#include <numeric>
#include <span>

#include "protocol/base/split_mix.h"

namespace gnomon {

namespace {

std::uint64_t edgeHash(std::uint32_t from, std::uint32_t to) {
  return splitMix64((std::uint64_t{from} << 32) | to);
}

/// Whether each edge is walked as often from a to b as back: the signed sum of hashes is 0 (false positives: 2^-64).
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

/// A side of a triangle, kept under the lower of its two vertices.
struct HalfEdge {
  std::uint32_t high = 0;
  bool upwards = false; ///< runs from the lower vertex to the higher one
  std::uint32_t triangle = 0;

  bool operator<(const HalfEdge& other) const {
    if (high != other.high) return high < other.high;
    if (upwards != other.upwards) return upwards;
    return triangle < other.triangle;
  }
};

/// Calls visit(lower vertex, half edge) for each side of each triangle whose corners lie at three places.
template <class Visit>
void eachHalfEdge(std::span<const std::uint32_t> welded, Visit visit) {
  for (std::size_t first = 0; first + 2 < welded.size(); first += 3) {
    const std::uint32_t corners[] = {welded[first], welded[first + 1], welded[first + 2]};
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t from = corners[corner];
      const std::uint32_t to = corners[(corner + 1) % 3];
      visit(std::min(from, to), HalfEdge{std::max(from, to), from < to, static_cast<std::uint32_t>(first / 3)});
    }
  }
}

/// The half edges of one pair of vertices, those upwards first: joined in their order as far as both ways exist.
void appendEdges(std::uint32_t low, std::span<const HalfEdge> halves, std::vector<MeshEdge>& edges) {
  const auto down = std::find_if(halves.begin(), halves.end(), [](const HalfEdge& half) { return !half.upwards; });
  const std::span<const HalfEdge> upwards(halves.begin(), down);
  const std::span<const HalfEdge> downwards(down, halves.end());
  const std::size_t pairs = std::min(upwards.size(), downwards.size());
  const std::uint32_t high = halves.front().high;
  for (std::size_t i = 0; i < upwards.size(); ++i) {
    edges.push_back({low, high, upwards[i].triangle, i < pairs ? downwards[i].triangle : kNoTriangle});
  }
  for (std::size_t i = pairs; i < downwards.size(); ++i) {
    edges.push_back({high, low, downwards[i].triangle, kNoTriangle});
  }
}

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

std::vector<MeshEdge> meshEdges(const Scene& scene, const Primitive& primitive) {
  const auto welded = std::span(scene.welded).subspan(primitive.firstIndex, primitive.indexCount);

  // Sorted by the lower vertex by counting, then each vertex's few by comparison.
  std::vector<std::size_t> begin(primitive.vertexCount + std::size_t{1});
  eachHalfEdge(welded, [&](std::uint32_t low, const HalfEdge&) { ++begin[low + std::size_t{1}]; });
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<HalfEdge> halves(begin.back());
  std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
  eachHalfEdge(welded, [&](std::uint32_t low, const HalfEdge& half) { halves[next[low]++] = half; });

  std::vector<MeshEdge> edges;
  edges.reserve(halves.size() / 2);
  for (std::uint32_t low = 0; low < primitive.vertexCount; ++low) {
    const auto ofVertex = std::span(halves).subspan(begin[low], begin[low + std::size_t{1}] - begin[low]);
    std::sort(ofVertex.begin(), ofVertex.end());
    for (auto first = ofVertex.begin(); first != ofVertex.end();) {
      const auto last =
          std::find_if(first, ofVertex.end(), [&](const HalfEdge& half) { return half.high != first->high; });
      appendEdges(low, {first, last}, edges);
      first = last;
    }
  }
  return edges;
}

} // namespace gnomon
