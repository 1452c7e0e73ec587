#include "renderer/scene/mesh_edges.h"

#include <algorithm>
#include <numeric>
#include <span>

namespace gnomon {
namespace {

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
