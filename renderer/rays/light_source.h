#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "protocol/spec/scene_options.h"
#include "protocol/spec/traits.h"
#include "renderer/core/camera_view.h"
#include "renderer/rays/ray_packet.h"
#include "renderer/rays/trace.h"

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

  bool operator==(const LightSource&) const = default;
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
  if (traitsOf(light.type).parallel) return {-light.axis, HUGE_VAL};
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

/// Which of a point's places on a light's disc rays go to: those from `first` up to `last`.
struct LightSamples {
  std::uint32_t first = 0, last = 1;
  /// How many there are in all, where that is known from the start: spread evenly for any number. 0 = the places of an
  /// endless sequence, whose first ones fill the disc evenly however many they are (sequencePlace).
  std::uint32_t of = 0;
};

/// Rays from a point to places all over a light's disc, a coordinate after the other.
struct SampleWays {
  double direction[3][kLanes];
  double length[kLanes];
  double cosine[kLanes]; ///< of the direction and `normal`
};

/// The ways to the first kLanes of these samples. `seed` shifts the samples. `normal`: of the point's surface.
void waysTo(const LightDisc& disc, const LightSamples& samples, std::uint64_t seed, const glm::dvec3& normal,
            SampleWays& ways);

/// Whether the light shines as far as the end of this way, and in its direction (KHR_lights_punctual).
inline bool reaches(const LightSource& light, const WayToLight& way) {
  if (traitsOf(light.type).parallel) return true;
  if (!(way.length > 0 && way.length < light.range)) return false;
  return !traitsOf(light.type).hasCone || glm::dot(light.axis, -way.direction) > light.cosOuter;
}

/// A surface faces a light from this cosine on. As in renderer/shaders/common_shadow.glsl.
inline constexpr double kFacingCosine = 1e-4;

/// Whether a surface of this normal (unit length, on the eye's side) takes light from there. A face along the light to
/// within the renderer's stored normals is turned away, as it is when frames are shaded.
inline bool faces(const glm::vec3& normal, const WayToLight& way) {
  return glm::dot(glm::dvec3(normal), way.direction) > kFacingCosine;
}

/// A place in the unit square, in units of 2^-32.
struct SquarePlace {
  std::uint32_t x = 0, y = 0;
};

/// Number `index` of Sobol's sequence in two dimensions, scrambled: each 2^k from a multiple of 2^k on leave none of
/// the 2^k rectangles of any one shape empty, whatever the places are XORed with.
SquarePlace sequencePlace(std::uint32_t index);

/// The places on a light that drawn points send rays to: a pixel's are the first ones of the sequence XORed with its
/// own shift. There is one for each pixel of a square of 4 x 4, and they are the same in every square: wherever in a
/// picture 4 x 4 pixels are taken, their first rays lie evenly all over the light between each other, and so do all of
/// them (Keller and Heidrich, "Interleaved Sampling", 2001). Later rays, where all four from a multiple of 4 on are
/// sent, go to the same places in another order: those of one number to the same quarter of the light from every pixel,
/// so that packets of rays stay close together.
class Interleaved {
 public:
  explicit Interleaved(std::uint32_t rays); ///< most of a pixel

  const SquarePlace& place(std::uint32_t ray) const { return places_[ray]; } ///< REQUIRES: ray < rays

  /// Whether a ray of those from `first` up to `last`, which are sent together, goes to one quarter from all pixels.
  static bool isAligned(std::uint32_t ray, std::uint32_t first, std::uint32_t last) {
    const std::uint32_t four = ray / 4 * 4;
    return four >= std::max(first, 4u) && four + 4 <= last;
  }

  /// What the places of such rays, or of others, are XORed with for a pixel.
  const SquarePlace& shift(std::uint32_t x, std::uint32_t y, bool aligned) const {
    return (aligned ? aligned_ : shifts_)[(y & 3) << 2 | (x & 3)];
  }

 private:
  std::array<SquarePlace, 16> shifts_, aligned_;
  std::vector<SquarePlace> places_;
};

/// From what the point is, and not from where it stands in a list: it gets the same samples every time.
std::uint64_t seedOf(const SurfacePoint& point);

} // namespace gnomon
