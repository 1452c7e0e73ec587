#include "renderer/reference/shading_normal.h"

#include "renderer/core/linear_algebra.h"
#include "renderer/reference/tree.h"
#include "renderer/reference/triangle.h"

namespace gnomon {

glm::dvec3 shadingNormal(const TracedScene::Tree& tree, const SurfacePoint& point) {
  const auto [a, b, c] = tree.vertices(point.instance, point.triangle);
  const Triangle triangle = tree.triangle(point.instance, point.triangle);
  const Barycentric at = crossingPlane(triangle, point.position, triangle.area(), {});
  const auto own = at.mix(glm::dvec3(a->normal), glm::dvec3(b->normal), glm::dvec3(c->normal));
  const glm::dvec3 face(point.normal);
  const glm::dmat3 turn = normalMatrix(glm::dmat3(tree.instance(point.instance).worldFromLocal));
  const glm::dvec3 normal = unitOr(turn * own, face);
  return tree.material(point.instance).doubleSided && glm::dot(normal, face) < 0 ? -normal : normal;
}

} // namespace gnomon
