#include "renderer/reference/shading_normal.h"

#include "renderer/core/cofactors.h"
#include "renderer/reference/tree.h"
#include "renderer/reference/triangle.h"

namespace gnomon {
namespace {

/// Weights of the point of the triangle's plane that lies nearest to `position`.
Barycentric weightsOf(const Triangle& triangle, const glm::dvec3& position) {
  const glm::dvec3 area = triangle.area();
  const glm::dvec3 from = position - triangle.a;
  const double squared = glm::dot(area, area);
  if (!(squared > 0)) return {};
  return {glm::dot(glm::cross(from, triangle.c - triangle.a), area) / squared,
          glm::dot(glm::cross(triangle.b - triangle.a, from), area) / squared};
}

} // namespace

glm::dvec3 shadingNormal(const TracedScene::Tree& tree, const SurfacePoint& point) {
  const Primitive& primitive = tree.primitive(point.instance);
  const std::uint32_t* corner = &tree.scene->indices[primitive.firstIndex + 3 * std::size_t{point.triangle}];
  const VertexAttributes* vertices = &tree.scene->attributes[primitive.baseVertex];
  const Barycentric at = weightsOf(tree.triangle(point.instance, point.triangle), point.position);
  const auto own = at.mix(glm::dvec3(vertices[corner[0]].normal), glm::dvec3(vertices[corner[1]].normal),
                          glm::dvec3(vertices[corner[2]].normal));
  const glm::dvec3 face(point.normal);
  const glm::dmat3 turn = normalMatrix(glm::dmat3(tree.instance(point.instance).worldFromLocal));
  const glm::dvec3 normal = unitOr(turn * own, face);
  return tree.material(point.instance).doubleSided && glm::dot(normal, face) < 0 ? -normal : normal;
}

} // namespace gnomon
