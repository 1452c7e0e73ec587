#include "renderer/reference/light_source.h"

#include <bit>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "renderer/core/light.h"
#include "renderer/core/vec3.h"

namespace gnomon {
namespace {

WayToLight wayAlong(const glm::dvec3& offset) {
  const double length = glm::length(offset);
  return {length > 0 ? offset / length : glm::dvec3(0), length};
}

/// Steele, Lea and Flood, "Fast Splittable Pseudorandom Number Generators", OOPSLA 2014.
std::uint64_t mixed(std::uint64_t z) {
  z += 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

std::uint32_t reversed(std::uint32_t bits) {
  bits = (bits >> 16) | (bits << 16);
  bits = ((bits & 0x00ff00ffu) << 8) | ((bits & 0xff00ff00u) >> 8);
  bits = ((bits & 0x0f0f0f0fu) << 4) | ((bits & 0xf0f0f0f0u) >> 4);
  bits = ((bits & 0x33333333u) << 2) | ((bits & 0xccccccccu) >> 2);
  return ((bits & 0x55555555u) << 1) | ((bits & 0xaaaaaaaau) >> 1);
}

/// Area for area from the unit square onto the unit disc (Shirley and Chiu, "A Low Distortion Map Between Disk and
/// Square", Journal of Graphics Tools 1997).
glm::dvec2 discFromSquare(const glm::dvec2& square) {
  const glm::dvec2 p = 2.0 * square - 1.0;
  if (p == glm::dvec2(0)) return p;
  const double quarter = 0.25 * glm::pi<double>();
  const bool wide = std::abs(p.x) > std::abs(p.y);
  const double radius = wide ? p.x : p.y;
  const double angle = wide ? quarter * (p.y / p.x) : 2 * quarter - quarter * (p.x / p.y);
  return radius * glm::dvec2(std::cos(angle), std::sin(angle));
}

} // namespace

LightSource lightSource(const Light& light, const glm::dvec3& anchor) {
  LightSource source;
  source.type = light.type;
  source.axis = directionOf(light);
  source.range = light.range.value_or(HUGE_VAL);
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
  if (light.type == LightType::directional) return {-light.axis, HUGE_VAL};
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
  if (disc.atInfinity) way.length = HUGE_VAL;
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

glm::dvec2 discSample(std::uint32_t index, std::uint32_t count, std::uint64_t seed) {
  // Hammersley's points (Niederreiter, "Random Number Generation and Quasi-Monte Carlo Methods", 1992, 3.2): shifted
  // along x, scrambled in y, which leaves one in each of the `count` strips either way.
  constexpr double kUnit = 1.0 / 4294967296.0;
  const double shift = static_cast<double>(seed >> 32) * kUnit;
  const double x = (index + shift) / count;
  const double y = (static_cast<double>(reversed(index) ^ static_cast<std::uint32_t>(seed)) + 0.5) * kUnit;
  return discFromSquare({x, y});
}

std::uint64_t seedOf(const SurfacePoint& point) {
  std::uint64_t seed = mixed((std::uint64_t{point.instance} << 32) | point.triangle);
  for (int axis = 0; axis < 3; ++axis) seed = mixed(seed ^ std::bit_cast<std::uint64_t>(point.position[axis]));
  return seed;
}

} // namespace gnomon
