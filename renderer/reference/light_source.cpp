#include "renderer/reference/light_source.h"

#include <cmath>

#include "renderer/core/light_direction.h"
#include "renderer/core/vec3.h"

namespace gnomon {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

WayToLight wayAlong(const glm::dvec3& offset) {
  const double length = glm::length(offset);
  return {length > 0 ? offset / length : glm::dvec3(0), length};
}

/// Two unit vectors at right angles to the unit vector `n` and to each other (Duff et al., "Building an Orthonormal
/// Basis, Revisited", JCGT 2017).
void basisAround(const glm::dvec3& n, glm::dvec3& first, glm::dvec3& second) {
  const double sign = std::copysign(1.0, n.z);
  const double a = -1.0 / (sign + n.z);
  const double b = n.x * n.y * a;
  first = {1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x};
  second = {b, sign + n.y * n.y * a, -n.y};
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

WayToLight wayTo(const LightSource& light, const glm::dvec3& point, glm::dvec2 place) {
  const WayToLight middle = wayTo(light, point);
  glm::dvec3 across, up;
  basisAround(middle.direction, across, up);
  const glm::dvec3 moved = (across * place.x + up * place.y) * light.radius;
  if (light.type == LightType::directional) return {glm::normalize(middle.direction + moved), kInfinity};
  return wayAlong(light.position - point + moved);
}

bool reaches(const LightSource& light, const WayToLight& way) {
  if (light.type == LightType::directional) return true;
  if (!(way.length > 0 && way.length < light.range)) return false;
  return light.type == LightType::point || glm::dot(light.axis, -way.direction) > light.cosOuter;
}

bool faces(const glm::dvec3& normal, const WayToLight& way) {
  constexpr double kLeastCosine = 1e-4; // as in renderer/shaders/common_shadow.glsl
  return glm::dot(normal, way.direction) > kLeastCosine;
}

} // namespace gnomon
