#include "renderer/rays/smooth_surface.h"

#include <algorithm>
#include <array>

#include "renderer/core/linear_algebra.h"
#include "renderer/rays/tree.h"
#include "renderer/rays/triangle.h"

namespace gnomon {
namespace {

namespace exactly {

using Real = double;
using glm::dot;
using glm::max;
using vec3 = glm::dvec3;

#define GNOMON_FUNCTION inline
#define GNOMON_CONSTANT(name, value) constexpr double name = value
#include "renderer/shaders/shared/smooth_surface.h"
#undef GNOMON_CONSTANT
#undef GNOMON_FUNCTION

} // namespace exactly

using Normals = std::array<glm::dvec3, 3>;

/// In the world, unit length; nothing where they are all the same, or one has no direction.
std::optional<Normals> normalsOf(const TracedScene::Tree& tree, const PlacedTriangle& triangle) {
  const auto corners = tree.vertices(triangle.instance, triangle.triangle);
  const glm::vec3& first = corners[0]->normal;
  if (first == corners[1]->normal && first == corners[2]->normal) return std::nullopt;
  const glm::dmat3 turn = normalMatrix(glm::dmat3(tree.instance(triangle.instance).worldFromLocal));
  Normals normals;
  for (std::size_t i = 0; i < 3; ++i) {
    normals[i] = unitOr(turn * glm::dvec3(corners[i]->normal), glm::dvec3(0));
    if (normals[i] == glm::dvec3(0)) return std::nullopt;
  }
  return normals;
}

/// As seen from a point: the cosine of a plane up to which it leaves some of the light behind it.
double leastWhole(const LightSource& light, const WayToLight& way) {
  return std::max(kFacingCosine, traitsOf(light.type).parallel ? light.radius : light.radius / way.length);
}

} // namespace

std::optional<SurfacePoint> smoothPoint(const TracedScene::Tree& tree, const LightSource& light,
                                        const SurfacePoint& point, const WayToLight& way) {
  const glm::dvec3 own(point.normal);
  const double cosine = glm::dot(own, way.direction);
  if (!(cosine <= leastWhole(light, way))) return std::nullopt;
  const PlacedTriangle placed{point.instance, point.triangle};
  const auto normals = normalsOf(tree, placed);
  const Triangle triangle = tree.triangle(placed.instance, placed.triangle);
  if (!normals || triangle.isSliver()) return std::nullopt;
  const auto& [a, b, c] = *normals;
  const glm::dvec3 p1 = triangle.b - triangle.a, p2 = triangle.c - triangle.a;
  const Barycentric at = crossing(triangle, point.position, triangle.area(), {});
  const glm::dvec3 between = unitAlong(at.mix(a, b, c));
  const double side = glm::dot(between, own) < 0 ? -1.0 : 1.0;
  const glm::dvec3 normal = side * between;
  const bool stands = glm::dot(normal, own) > exactly::kLeastLikeness &&
                      side * exactly::outwardBend(p1, p2, b - a, c - a) > 0 &&
                      exactly::smoothGain(cosine, glm::dot(normal, way.direction)) > 0;
  if (!stands) return std::nullopt;
  const double height = std::max(0.0, side * exactly::heightOverTriangle(at.u, at.v, p1, p2, b - a, c - a));
  return SurfacePoint{point.position + normal * height, glm::vec3(normal), point.instance, point.triangle, true};
}

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

bool mayFace(const TracedScene::Tree& tree, const LightSource& light, const PlacedTriangle& shown,
             const glm::dvec3& normal) {
  const auto normals = normalsOf(tree, shown);
  if (!normals) return false;
  const Triangle triangle = tree.triangle(shown.instance, shown.triangle);
  const auto [least, most] =
      std::minmax({glm::dot((*normals)[0], normal), glm::dot((*normals)[1], normal), glm::dot((*normals)[2], normal)});
  if (least <= 0 && most >= 0) return true;
  const double side = least > 0 ? 1.0 : -1.0;
  return std::any_of(normals->begin(), normals->end(), [&](const glm::dvec3& own) {
    const auto faced = [&](const glm::dvec3& from) { return side * glm::dot(own, wayTo(light, from).direction) > 0; };
    return traitsOf(light.type).parallel ? faced(triangle.a)
                                         : faced(triangle.a) || faced(triangle.b) || faced(triangle.c);
  });
}

} // namespace gnomon
