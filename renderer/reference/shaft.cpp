#include "renderer/reference/shaft.h"

#include <algorithm>

namespace gnomon {
namespace {

/// In the units of the tree, whose coordinates are below 2: ten times what floats lose of a sum of their products.
constexpr double kMargin = 0x1p-18;

/// Where the light's middle lies from a point: a direction of unit length for directional lights, else metres. The
/// light's radius is of the same measure.
glm::dvec3 towards(const LightSource& light, const glm::dvec3& from) {
  return light.type == LightType::directional ? -light.axis : light.position - from;
}

/// Inside: dot(normal, p - on) >= 0.
glm::vec4 plane(const glm::dvec3& normal, const glm::dvec3& on, double scale) {
  return {glm::vec3(normal), static_cast<float>(kMargin - glm::dot(normal, on * scale))};
}

/// The plane through a side of the block that has the rest of the block and the whole light on one side of it.
std::optional<glm::vec4> sidePlane(const LightSource& light, const glm::dvec3& from, const glm::dvec3& to,
                                   const glm::dvec3& inwards, double scale) {
  const glm::dvec3 side = to - from;
  const double length = glm::length(side);
  if (!(length > 0)) return std::nullopt;
  const glm::dvec3 along = side / length;
  const glm::dvec3 toLight = towards(light, from);
  const glm::dvec3 across = toLight - along * glm::dot(toLight, along);
  const double distance = glm::length(across);
  if (!(distance > light.radius) || !(distance > 1e-6 * glm::length(toLight))) return std::nullopt;
  const glm::dvec3 away = across / distance;
  glm::dvec3 normal = glm::cross(along, away);
  if (glm::dot(normal, inwards) < 0) normal = -normal;
  // Turned about the side until it touches the light from outside.
  const double sine = light.radius / distance;
  return plane(normal * std::sqrt(1 - sine * sine) + away * sine, from, scale);
}

/// Of a block that lies askew to the light, a far part may lie outside of a plane that is turned to it.
bool holds(const glm::vec4& plane, const FlatBlock& block, double scale) {
  return std::all_of(block.corners.begin(), block.corners.end(), [&](const glm::dvec3& corner) {
    return glm::dot(glm::dvec3(plane), corner * scale) + double{plane.w} >= 0;
  });
}

} // namespace

std::optional<Shaft> shaftTo(const LightSource& light, const FlatBlock& block, double scale) {
  const glm::dvec3 middle = (block.corners[0] + block.corners[1] + block.corners[2] + block.corners[3]) / 4.0;
  const glm::dvec3 toLight = towards(light, middle);
  const double distance = glm::length(toLight);
  if (!(glm::dot(block.normal, toLight) > light.radius + 1e-6 * distance)) return std::nullopt;
  Shaft shaft;
  for (std::size_t i = 0; i < 4; ++i) {
    const glm::dvec3& from = block.corners[i];
    const auto side = sidePlane(light, from, block.corners[(i + 1) % 4], middle - from, scale);
    if (!side || !holds(*side, block, scale)) return std::nullopt;
    shaft.planes[i] = *side;
  }
  shaft.planes[4] = plane(block.normal, middle, scale);
  shaft.planes[5] = {0, 0, 0, 1};
  const glm::dvec3 beyond = middle + toLight * (1 + light.radius / distance);
  if (light.type != LightType::directional && glm::length(beyond * scale) < 4) {
    const glm::vec4 end = plane(-toLight / distance, beyond, scale);
    if (holds(end, block, scale)) shaft.planes[5] = end;
  }
  return shaft;
}

} // namespace gnomon
