#include "renderer/reference/light_source.h"

#include <cmath>

#include "renderer/core/light.h"
#include "renderer/core/vec3.h"

namespace gnomon {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

WayToLight wayAlong(const glm::dvec3& offset) {
  const double length = glm::length(offset);
  return {length > 0 ? offset / length : glm::dvec3(0), length};
}

} // namespace

LightSource lightSource(const Light& light, const glm::dvec3& anchor) {
  LightSource source;
  source.type = light.type;
  source.axis = directionOf(light);
  source.range = light.range.value_or(kInfinity);
  if (light.type == LightType::directional) {
    source.radius = std::tan(0.5 * glm::radians(light.angularDiameterDegrees.value_or(0.0)));
    return source;
  }
  if (light.position) source.position = toVector(*light.position) - anchor;
  if (light.type == LightType::spot) source.cosOuter = std::cos(glm::radians(light.outerConeDegrees));
  source.radius = light.radius.value_or(0.0);
  return source;
}

WayToLight wayTo(const LightSource& light, const glm::dvec3& point) {
  if (light.type == LightType::directional) return {-light.axis, kInfinity};
  return wayAlong(light.position - point);
}

LightDisc discFacing(const LightSource& light, const glm::dvec3& point) {
  const WayToLight way = wayTo(light, point);
  const glm::dvec3& n = way.direction;
  // Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 2017.
  const double sign = std::copysign(1.0, n.z);
  const double a = -1.0 / (sign + n.z);
  const double b = n.x * n.y * a;
  LightDisc disc;
  disc.across = light.radius * glm::dvec3(1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x);
  disc.up = light.radius * glm::dvec3(b, sign + n.y * n.y * a, -n.y);
  disc.atInfinity = light.type == LightType::directional;
  disc.middle = disc.atInfinity ? n : light.position - point;
  return disc;
}

WayToLight wayTo(const LightDisc& disc, glm::dvec2 place) {
  WayToLight way = wayAlong(disc.middle + disc.across * place.x + disc.up * place.y);
  if (disc.atInfinity) way.length = kInfinity;
  return way;
}

bool reaches(const LightSource& light, const WayToLight& way) {
  if (light.type == LightType::directional) return true;
  if (!(way.length > 0 && way.length < light.range)) return false;
  return light.type == LightType::point || glm::dot(light.axis, -way.direction) > light.cosOuter;
}

bool faces(const glm::vec3& normal, const WayToLight& way) {
  constexpr double kLeastCosine = 1e-4; // as in renderer/shaders/common_shadow.glsl
  return glm::dot(glm::dvec3(normal), way.direction) > kLeastCosine;
}

} // namespace gnomon
