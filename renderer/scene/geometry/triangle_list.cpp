#include "renderer/scene/geometry/triangle_list.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "renderer/core/aabb.h"

namespace gnomon {

namespace {

/// The corners in the order of the file, before strips and fans are unrolled.
std::vector<std::uint32_t> readCorners(const PrimitiveSource& source, Findings& findings) {
  const std::size_t vertexCount = source.positions->count;
  std::vector<std::uint32_t> corners(source.corners());
  if (!source.indices) {
    for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = static_cast<std::uint32_t>(i);
    return corners;
  }
  const std::size_t bits = 8 * bytesOf(source.indices->componentType);
  const auto restart = static_cast<std::uint32_t>((std::uint64_t{1} << bits) - 1);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    corners[i] = source.indices->readIndex(i);
    if (corners[i] < vertexCount && corners[i] != restart) continue;
    findings.invalid(source.pointer + "/indices",
                     corners[i] == restart ? "An index is the primitive restart value."
                                           : "An index names a vertex that does not exist.",
                     "below " + std::to_string(vertexCount),
                     std::to_string(corners[i]) + " at position " + std::to_string(i));
    return {};
  }
  return corners;
}

} // namespace

std::vector<std::uint32_t> readTriangles(const PrimitiveSource& source, Findings& findings) {
  std::vector<std::uint32_t> corners = readCorners(source, findings);
  if (source.mode == PrimitiveMode::triangles) {
    corners.resize(corners.size() / 3 * 3);
    return corners;
  }
  if (corners.size() < 3) return {};
  const bool fan = source.mode == PrimitiveMode::triangleFan;
  std::vector<std::uint32_t> triangles;
  triangles.reserve((corners.size() - 2) * 3);
  for (std::size_t i = 0; i + 2 < corners.size(); ++i) {
    const std::array<std::size_t, 3> at =
        fan ? std::array<std::size_t, 3>{i + 1, i + 2, 0} : std::array<std::size_t, 3>{i, i + 1 + i % 2, i + 2 - i % 2};
    for (const std::size_t corner : at) triangles.push_back(corners[corner]);
  }
  return triangles;
}

void dropUndrawable(std::vector<std::uint32_t>& corners, const PrimitiveSource& source, Findings& findings) {
  std::size_t kept = 0;
  std::size_t notFinite = 0;
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
    const glm::dvec3 a(source.positions->read(corners[i]));
    const glm::dvec3 b(source.positions->read(corners[i + 1]));
    const glm::dvec3 c(source.positions->read(corners[i + 2]));
    if (!finite(a) || !finite(b) || !finite(c)) {
      ++notFinite;
      continue;
    }
    if (!source.deforms() && glm::cross(b - a, c - a) == glm::dvec3(0)) continue;
    std::copy_n(corners.begin() + static_cast<std::ptrdiff_t>(i), 3,
                corners.begin() + static_cast<std::ptrdiff_t>(kept));
    kept += 3;
  }
  corners.resize(kept);
  if (notFinite > 0) {
    findings.warn("The primitive " + source.pointer + " has " + std::to_string(notFinite) +
                  " triangles with positions that are not finite; they are not drawn.");
  }
}

std::vector<std::uint32_t> compactVertices(std::vector<std::uint32_t>& corners, std::size_t vertexCount) {
  std::vector<std::uint32_t> used;
  if (corners.size() < vertexCount) { // a part of a large shared accessor: no table of the accessor's size
    used = corners;
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    for (std::uint32_t& corner : corners) {
      corner = static_cast<std::uint32_t>(std::lower_bound(used.begin(), used.end(), corner) - used.begin());
    }
    return used;
  }
  constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> newIndex(vertexCount, kUnused);
  for (const std::uint32_t corner : corners) newIndex[corner] = 0;
  for (std::uint32_t vertex = 0; vertex < vertexCount; ++vertex) {
    if (newIndex[vertex] == kUnused) continue;
    newIndex[vertex] = static_cast<std::uint32_t>(used.size());
    used.push_back(vertex);
  }
  for (std::uint32_t& corner : corners) corner = newIndex[corner];
  return used;
}

} // namespace gnomon
