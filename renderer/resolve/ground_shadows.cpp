#include "renderer/resolve/ground_shadows.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <vector>

#include "protocol/spec/frame_lights.h"
#include "protocol/spec/traits.h"
#include "renderer/core/light.h"
#include "renderer/core/linear_algebra.h"
#include "renderer/resolve/resolve_frame.h"

namespace gnomon {
namespace {

/// Less of a fall than this, of a ray of length 1, and its shadow counts as endless.
constexpr double kLeastFall = 0.02;

std::vector<glm::dvec3> cornersOf(const Aabb& box) {
  std::vector<glm::dvec3> corners;
  for (int i = 0; i < 8; ++i) {
    corners.emplace_back((i & 1) != 0 ? box.max.x : box.min.x, (i & 2) != 0 ? box.max.y : box.min.y,
                         (i & 4) != 0 ? box.max.z : box.min.z);
  }
  return corners;
}

/// Ways from the light that span the cone of all ways from its disc.
std::vector<glm::dvec3> waysFrom(const Light& light) {
  const glm::dvec3 middle = directionOf(light);
  const double radius = radiusOf(light);
  if (radius == 0) return {middle};
  constexpr int kSides = 8;
  const glm::dvec3 across =
      glm::normalize(glm::cross(middle, std::abs(middle.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0)));
  const glm::dvec3 up = glm::cross(across, middle);
  std::vector<glm::dvec3> ways;
  for (int i = 0; i < kSides; ++i) {
    const double angle = glm::two_pi<double>() * i / kSides;
    const double outside = radius / std::cos(glm::pi<double>() / kSides);
    ways.push_back(glm::normalize(middle + outside * (std::cos(angle) * across + std::sin(angle) * up)));
  }
  return ways;
}

/// Adds where the shadow of a point falls; false = anywhere.
bool addShadow(const glm::dvec3& point, const glm::dvec3& way, double height, Aabb& shadow) {
  if (point.y <= height) return true;
  if (-way.y < kLeastFall) return false;
  shadow.add(point + way * ((point.y - height) / -way.y));
  return true;
}

bool addShadows(const Aabb& casters, const Light& light, double height, Aabb& shadow) {
  if (traitsOf(light.type).parallel) {
    const glm::dvec3 middle = directionOf(light);
    if (middle.y >= radiusOf(light)) return true; // from below, which the ground does not show
    const std::vector<glm::dvec3> ways = waysFrom(light);
    for (const glm::dvec3& corner : cornersOf(casters)) {
      for (const glm::dvec3& way : ways) {
        if (!addShadow(corner, way, height, shadow)) return false;
      }
    }
    return true;
  }
  const glm::dvec3 place = toVector(*light.position);
  const double radius = radiusOf(light);
  if (place.y + radius <= height) return true;
  for (const glm::dvec3& from : cornersOf({place - radius, place + radius})) {
    for (const glm::dvec3& corner : cornersOf(casters)) {
      if (!addShadow(corner, glm::normalize(corner - from), height, shadow)) return false;
    }
  }
  return true;
}

} // namespace

std::optional<Aabb> shadowsOnGround(const FrameSpec& spec, const SceneView& view, std::span<const NodeSwitches> nodes,
                                    double height) {
  const EnvironmentOptions& around = spec.environment;
  const bool mayHaveSun = !isStudio(around); // which is found later
  if (!spec.volumes.empty() || mayHaveSun || around.shadows != EnvironmentShadows::none) return std::nullopt;
  const std::vector<Light> lights = lightsOf(spec, lightsOf(view));
  Aabb shadow;
  double blur = 0;
  for (const int index : shadowingLights(lights, spec.shadowLightPolicy)) {
    const Light& light = lights[static_cast<std::size_t>(index)];
    Aabb casters;
    for (const Instance& instance : view.instances) {
      if (castsFrom(light, switchesOf(nodes, instance.node))) casters.add(instance.bounds);
    }
    if (casters.empty()) continue;
    if (!addShadows(casters, light, height, shadow)) return std::nullopt;
    blur = std::max(blur, light.shadow->filter.radius.value_or(0.0));
  }
  if (!shadow.empty()) shadow = {shadow.min - blur, shadow.max + blur};
  return shadow;
}

} // namespace gnomon
