#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "renderer/core/aabb.h"
#include "renderer/core/linear_algebra.h"
#include "renderer/scene/geometry/mesh_source.h"

namespace gnomon {

namespace {

/// Instead of a vertex that does not exist.
constexpr std::uint32_t kNoVertex = std::numeric_limits<std::uint32_t>::max();

const Repair kBeyondVertices{"An index names a vertex that does not exist", "the triangles that use it are left out",
                             true};
const Repair kRestart{"An index is the primitive restart value", "the triangles that use it are left out", true};
const Repair kNotFinite{"Triangles have positions that are not finite", "they are left out", true};
const Repair kNoDirection{"Normals or tangents have the length 0 or are not finite",
                          "they are computed from the triangles"};
const Repair kUvNotFinite{"Texture coordinates are not finite", "they count as 0"};

/// The corners in the order of the file, before strips and fans are unrolled. `restarts`: places of the primitive
/// restart value.
std::vector<std::uint32_t> readCorners(const PrimitiveSource& source, std::vector<std::size_t>& restarts,
                                       Findings& findings) {
  const std::size_t vertexCount = source.positions->count;
  std::vector<std::uint32_t> corners(source.corners());
  if (!source.indices) {
    for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = static_cast<std::uint32_t>(i);
    return corners;
  }
  const std::size_t bits = 8 * bytesOf(source.indices->componentType);
  const auto restart = static_cast<std::uint32_t>((std::uint64_t{1} << bits) - 1);
  std::optional<std::size_t> beyond;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    corners[i] = source.indices->readIndex(i);
    if (corners[i] < vertexCount && corners[i] != restart) continue;
    if (corners[i] == restart) {
      restarts.push_back(i);
    } else if (!beyond) {
      beyond = i;
      findings.repair(kBeyondVertices, source.pointer + "/indices", "below " + std::to_string(vertexCount),
                      std::to_string(corners[i]) + " at position " + std::to_string(i));
    }
    corners[i] = kNoVertex;
  }
  if (!restarts.empty()) {
    findings.repair(kRestart, source.pointer + "/indices", {}, "at position " + std::to_string(restarts.front()));
  }
  return corners;
}

void addTriangle(const std::array<std::uint32_t, 3>& triangle, std::vector<std::uint32_t>& triangles) {
  if (std::ranges::find(triangle, kNoVertex) != triangle.end()) return;
  triangles.insert(triangles.end(), triangle.begin(), triangle.end());
}

/// A strip or fan, with the winding that glTF 2.0, 3.7.2.1 gives its triangles.
void unroll(std::span<const std::uint32_t> run, PrimitiveMode mode, std::vector<std::uint32_t>& triangles) {
  for (std::size_t i = 0; i + 2 < run.size(); ++i) {
    if (mode == PrimitiveMode::triangleFan) {
      addTriangle({run[i + 1], run[i + 2], run[0]}, triangles);
    } else {
      addTriangle({run[i], run[i + 1 + i % 2], run[i + 2 - i % 2]}, triangles);
    }
  }
}

/// The corners of a primitive's triangles, three after three, all below positions->count; strips and fans begin again
/// after a restart.
std::vector<std::uint32_t> readTriangles(const PrimitiveSource& source, Findings& findings) {
  std::vector<std::size_t> restarts;
  std::vector<std::uint32_t> corners = readCorners(source, restarts, findings);
  std::vector<std::uint32_t> triangles;
  if (source.mode == PrimitiveMode::triangles) {
    corners.resize(corners.size() / 3 * 3);
    if (std::ranges::find(corners, kNoVertex) == corners.end()) return corners;
    triangles.reserve(corners.size());
    for (std::size_t i = 0; i < corners.size(); i += 3) {
      addTriangle({corners[i], corners[i + 1], corners[i + 2]}, triangles);
    }
    return triangles;
  }
  triangles.reserve(source.triangles() * 3);
  restarts.push_back(corners.size());
  std::size_t first = 0;
  for (const std::size_t end : restarts) {
    unroll(std::span(corners).subspan(first, end - first), source.mode, triangles);
    first = end + 1;
  }
  return triangles;
}

/// Drops triangles that are not finite, with a repair, and those without an area unless a pose may give them one.
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
  if (notFinite > 0) findings.repair(kNotFinite, source.pointer, {}, std::to_string(notFinite) + " triangles");
}

/// The vertices that the corners use, ascending; the corners become indices into them.
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

/// Any unit vector perpendicular to the unit vector n.
glm::dvec3 perpendicularTo(const glm::dvec3& n) {
  const glm::dvec3 axis = std::abs(n.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  return glm::normalize(glm::cross(n, axis));
}

std::uint16_t to16Bit(double value) {
  if (!(value > 0)) return 0; // NaN too
  return static_cast<std::uint16_t>(std::lround(std::min(value, 1.0) * 65535.0));
}

/// Twice the area vector of the triangle that starts at indices[corner].
glm::dvec3 areaVector(const TriangleMesh& mesh, std::size_t corner) {
  const glm::dvec3 a(mesh.positions[mesh.indices[corner]]);
  const glm::dvec3 b(mesh.positions[mesh.indices[corner + 1]]);
  const glm::dvec3 c(mesh.positions[mesh.indices[corner + 2]]);
  return glm::cross(b - a, c - a);
}

/// Each triangle has its own vertices here.
void setFlatNormals(TriangleMesh& mesh) {
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const glm::vec3 normal(unitOr(areaVector(mesh, i), glm::dvec3(0)));
    for (std::size_t corner = 0; corner < 3; ++corner) mesh.attributes[mesh.indices[i + corner]].normal = normal;
  }
}

/// Gives vertices whose normal is zero the direction of the area around them. True if there were any.
bool replaceMissingNormals(TriangleMesh& mesh) {
  std::vector<glm::dvec3> area;
  for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
    const std::uint32_t vertex = mesh.indices[i];
    if (mesh.attributes[vertex].normal != glm::vec3(0)) continue;
    area.resize(mesh.positions.size(), glm::dvec3(0));
    area[vertex] += areaVector(mesh, i / 3 * 3);
  }
  for (std::size_t vertex = 0; vertex < area.size(); ++vertex) {
    if (mesh.attributes[vertex].normal != glm::vec3(0)) continue;
    const glm::dvec3 direction = unitOr(area[vertex], glm::dvec3(0));
    mesh.attributes[vertex].normal = direction == glm::dvec3(0) ? glm::vec3(0, 0, 1) : glm::vec3(direction);
  }
  return !area.empty();
}

/// True if a tangent had to be replaced.
bool setTangents(TriangleMesh& mesh, const AccessorView& view) {
  bool replaced = false;
  for (std::size_t i = 0; i < mesh.sources.size(); ++i) {
    const glm::dvec4 tangent = view.read(mesh.sources[i]);
    glm::dvec3 direction = unitOr(glm::dvec3(tangent), glm::dvec3(0));
    if (direction == glm::dvec3(0)) {
      direction = perpendicularTo(glm::dvec3(mesh.attributes[i].normal));
      replaced = true;
    }
    mesh.attributes[i].tangent = glm::vec4(glm::vec3(direction), tangent.w < 0 ? -1.0f : 1.0f);
  }
  return replaced;
}

glm::vec2 texCoordAt(const AccessorView* view, std::uint32_t vertex, bool& someNotFinite) {
  if (!view) return glm::vec2(0);
  const glm::dvec2 value(view->read(vertex));
  if (std::isfinite(value.x) && std::isfinite(value.y)) return glm::vec2(value);
  someNotFinite = true;
  return glm::vec2(0);
}

VertexAttributes attributesAt(const PrimitiveSource& source, std::uint32_t vertex, bool& someUvNotFinite) {
  VertexAttributes attributes;
  if (source.normals) attributes.normal = glm::vec3(unitOr(glm::dvec3(source.normals->read(vertex)), glm::dvec3(0)));
  attributes.uv0 = texCoordAt(source.texCoords[0], vertex, someUvNotFinite);
  attributes.uv1 = texCoordAt(source.texCoords[1], vertex, someUvNotFinite);
  if (source.colors) {
    const glm::dvec4 color = source.colors->read(vertex, glm::dvec4(source.colorMost)) / source.colorMost;
    attributes.color = glm::u16vec4(to16Bit(color.r), to16Bit(color.g), to16Bit(color.b), to16Bit(color.a));
  }
  return attributes;
}

} // namespace

TriangleMesh buildVertices(const PrimitiveSource& source, Findings& findings) {
  TriangleMesh mesh;
  mesh.indices = readTriangles(source, findings);
  dropUndrawable(mesh.indices, source, findings);

  mesh.flat = !source.normals;
  if (source.normals) {
    mesh.sources = compactVertices(mesh.indices, source.positions->count);
  } else {
    mesh.sources = mesh.indices;
    for (std::size_t i = 0; i < mesh.sources.size(); ++i) mesh.indices[i] = static_cast<std::uint32_t>(i);
  }

  mesh.positions.reserve(mesh.sources.size());
  mesh.attributes.reserve(mesh.sources.size());
  bool someUvNotFinite = false;
  for (const std::uint32_t vertex : mesh.sources) {
    mesh.positions.emplace_back(source.positions->read(vertex));
    mesh.attributes.push_back(attributesAt(source, vertex, someUvNotFinite));
  }
  if (someUvNotFinite) findings.repair(kUvNotFinite, source.pointer);

  if (mesh.flat) {
    setFlatNormals(mesh);
    return mesh;
  }
  bool replaced = replaceMissingNormals(mesh);
  mesh.hasTangents = source.tangents != nullptr;
  if (source.tangents && setTangents(mesh, *source.tangents)) replaced = true;
  if (replaced) findings.repair(kNoDirection, source.pointer);
  return mesh;
}

} // namespace gnomon
