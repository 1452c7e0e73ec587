#include "renderer/shadow/tile_size.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/gtc/constants.hpp>

#include "renderer/core/camera_view.h"

namespace gnomon {
namespace {

bool isInView(const CameraView& view, const Sphere& sphere) {
  const Frustum frustum = frustumOf(view);
  const bool beforePlanes = std::all_of(frustum.planes.begin(), frustum.planes.end(), [&](const glm::dvec4& plane) {
    return glm::dot(glm::dvec3(plane), sphere.center) + plane.w >= -sphere.radius * glm::length(glm::dvec3(plane));
  });
  return beforePlanes &&
         mayIntersect(frustum, {sphere.center - glm::dvec3(sphere.radius), sphere.center + glm::dvec3(sphere.radius)});
}

/// Diameter of the circle around a sphere's picture, in lengths of the picture plane 1 m ahead; infinite where the
/// sphere reaches the plane of the eye. The picture is an ellipse along the way from the picture's middle, from the
/// tangent of one rim's angle to that of the other's.
double projectedDiameter(const CameraView& view, const Sphere& sphere) {
  const double distance = glm::length(sphere.center);
  const double offAxis = std::acos(std::clamp(glm::dot(sphere.center, view.forward) / distance, -1.0, 1.0));
  const double halfAngle = std::asin(std::min(1.0, sphere.radius / distance));
  if (offAxis + halfAngle >= 0.5 * glm::pi<double>()) return HUGE_VAL;
  return std::tan(offAxis + halfAngle) - std::tan(offAxis - halfAngle);
}

} // namespace

int askedTileSize(ShadowSize size, ShadowImportance importance, int baseSize, int lightSize) {
  if (lightSize <= 0 || baseSize <= 0) return 0;
  // In 32nds of a texel every factor is a whole power of two, and nextPowerOfTwo scales with it.
  const int doublings = static_cast<int>(size) - static_cast<int>(ShadowSize::XSmall) + static_cast<int>(importance) -
                        static_cast<int>(ShadowImportance::low);
  const std::uint64_t byLight = std::bit_ceil(static_cast<std::uint64_t>(lightSize)) << doublings;
  const std::uint64_t byBase = static_cast<std::uint64_t>(baseSize) << doublings;
  return static_cast<int>(std::max<std::uint64_t>(1, std::min(byLight, byBase) / 32));
}

// A cone of half angle a up to 45 degrees, cut by a sphere of radius R about its apex, fits the sphere through apex and
// rim; a wider one the sphere about its rim.
Sphere reachOf(const ShadowCaster& light) {
  if (light.type == LightType::point) return {light.position, light.range};
  const double cosine = std::cos(light.outerCone);
  if (light.outerCone <= glm::radians(45.0)) {
    const double radius = light.range / (2.0 * cosine);
    return {light.position + light.direction * radius, radius};
  }
  return {light.position + light.direction * (light.range * cosine), light.range * std::sin(light.outerCone)};
}

int lightSize(const ShadowCaster& light, const CameraView& view, int frameWidth, int frameHeight) {
  const int longest = std::max(frameWidth, frameHeight);
  if (light.type == LightType::directional || light.range <= 0) return longest;
  const Sphere sphere = reachOf(light);
  if (!isInView(view, sphere)) return 0;
  if (view.perspective && glm::length(sphere.center) <= sphere.radius) return longest;
  const double across = view.perspective ? projectedDiameter(view, sphere) : 2.0 * sphere.radius;
  const double pixels = across * frameHeight / (2.0 * view.halfSize.y);
  return static_cast<int>(std::ceil(std::min<double>(pixels, longest)));
}

} // namespace gnomon
