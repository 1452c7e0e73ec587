#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

#include "protocol/spec/scene_options.h"
#include "renderer/core/camera_view.h"
#include "renderer/reference/ray_packet.h"
#include "renderer/reference/trace.h"

namespace gnomon {

/// A light as rays meet it; metres, relative to the scene's anchor.
struct LightSource {
  LightType type = LightType::directional;
  glm::dvec3 axis{0};     ///< where it shines; unit length; directional and spot
  glm::dvec3 position{0}; ///< spot and point
  double range = 0;       ///< infinite where the light has none
  double cosOuter = -1;   ///< of the cone's half angle; spot
  /// Of the disc that shines: its radius as seen from 1 m for directional lights, else in metres; 0 = a point.
  double radius = 0;
};

LightSource lightSource(const Light& light, const glm::dvec3& anchor);

/// The way from a point to the middle of the light.
struct WayToLight {
  glm::dvec3 direction{0}; ///< unit length; zero where the point is the light's own
  double length = 0;       ///< infinite for directional lights
};

inline WayToLight wayAlong(const glm::dvec3& offset) {
  const double length = glm::length(offset);
  return {length > 0 ? offset / length : glm::dvec3(0), length};
}

inline WayToLight wayTo(const LightSource& light, const glm::dvec3& point) {
  if (light.type == LightType::directional) return {-light.axis, HUGE_VAL};
  return wayAlong(light.position - point);
}

/// A light's disc, turned to face a point.
struct LightDisc {
  glm::dvec3 middle{0}; ///< from the point, metres; unit length for directional lights
  glm::dvec3 across{0}; ///< radii
  glm::dvec3 up{0};
  bool atInfinity = false;
};

LightDisc discFacing(const LightSource& light, const glm::dvec3& point);

/// Rays from a point to places all over a light's disc, a coordinate after the other.
struct SampleWays {
  double direction[3][kLanes];
  double length[kLanes];
  double cosine[kLanes]; ///< of the direction and `normal`
};

/// The ways to places `first` .. `first` + kLanes of the disc (discSample). `normal`: of the point's surface.
void waysTo(const LightDisc& disc, std::uint32_t first, std::uint32_t count, std::uint64_t seed,
            const glm::dvec3& normal, SampleWays& ways);

/// Whether the light shines as far as the end of this way, and in its direction (KHR_lights_punctual).
inline bool reaches(const LightSource& light, const WayToLight& way) {
  if (light.type == LightType::directional) return true;
  if (!(way.length > 0 && way.length < light.range)) return false;
  return light.type == LightType::point || glm::dot(light.axis, -way.direction) > light.cosOuter;
}

/// Whether a surface of this normal (unit length, on the eye's side) takes light from there. A face along the light to
/// within the renderer's stored normals is turned away, as it is when frames are shaded.
inline bool faces(const glm::vec3& normal, const WayToLight& way) {
  constexpr double kLeastCosine = 1e-4; // as in renderer/shaders/common_shadow.glsl
  return glm::dot(glm::dvec3(normal), way.direction) > kLeastCosine;
}

/// Number `index` of `count` places in the unit disc, spread evenly over its area for any count. `seed` shifts them.
glm::dvec2 discSample(std::uint32_t index, std::uint32_t count, std::uint64_t seed);

/// From what the point is, and not from where it stands in a list: it gets the same samples every time.
std::uint64_t seedOf(const SurfacePoint& point);

} // namespace gnomon
