#include "renderer/scene/geometry/vertex_build.h"

#include <algorithm>
#include <cmath>

#include "renderer/core/aabb.h"
#include "renderer/scene/geometry/triangle_list.h"

namespace gnomon {

namespace {

/// The unit vector along v, or zero where there is none.
glm::dvec3 directionOf(const glm::dvec3& v) {
  const double length = glm::length(v);
  return std::isfinite(length) && length > 0 ? v / length : glm::dvec3(0);
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
    const glm::vec3 normal(directionOf(areaVector(mesh, i)));
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
    const glm::dvec3 direction = directionOf(area[vertex]);
    mesh.attributes[vertex].normal = direction == glm::dvec3(0) ? glm::vec3(0, 0, 1) : glm::vec3(direction);
  }
  return !area.empty();
}

/// True if a tangent had to be replaced.
bool setTangents(TriangleMesh& mesh, const AccessorView& view) {
  bool replaced = false;
  for (std::size_t i = 0; i < mesh.sources.size(); ++i) {
    const glm::dvec4 tangent = view.read(mesh.sources[i]);
    glm::dvec3 direction = directionOf(glm::dvec3(tangent));
    if (direction == glm::dvec3(0)) {
      direction = perpendicularTo(glm::dvec3(mesh.attributes[i].normal));
      replaced = true;
    }
    mesh.attributes[i].tangent = glm::vec4(glm::vec3(direction), tangent.w < 0 ? -1.0f : 1.0f);
  }
  return replaced;
}

glm::vec2 texCoordAt(const AccessorView* view, std::uint32_t vertex) {
  if (!view) return glm::vec2(0);
  const glm::dvec4 value = view->read(vertex);
  return finite(value) ? glm::vec2(value) : glm::vec2(0);
}

VertexAttributes attributesAt(const PrimitiveSource& source, std::uint32_t vertex) {
  VertexAttributes attributes;
  if (source.normals) attributes.normal = glm::vec3(directionOf(glm::dvec3(source.normals->read(vertex))));
  attributes.uv0 = texCoordAt(source.texCoords[0], vertex);
  attributes.uv1 = texCoordAt(source.texCoords[1], vertex);
  if (source.colors) {
    const glm::dvec4 color = source.colors->read(vertex, glm::dvec4(1));
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
  for (const std::uint32_t vertex : mesh.sources) {
    mesh.positions.emplace_back(source.positions->read(vertex));
    mesh.attributes.push_back(attributesAt(source, vertex));
  }

  if (mesh.flat) {
    setFlatNormals(mesh);
    return mesh;
  }
  bool replaced = replaceMissingNormals(mesh);
  mesh.hasTangents = source.tangents != nullptr;
  if (source.tangents && setTangents(mesh, *source.tangents)) replaced = true;
  if (replaced) {
    findings.warn("The primitive " + source.pointer +
                  " has normals or tangents without a direction; they are taken from its shape.");
  }
  return mesh;
}

} // namespace gnomon
