#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "renderer/volume/medium.h"

namespace gnomon {

inline constexpr int kMaxVolumeLightSide = 64; ///< texels, of a map without a given size

/// Light on its way to one place.
struct Arrival {
  glm::dvec3 towards{0, 1, 0}; ///< the light, unit length
  double distance = std::numeric_limits<double>::infinity();
  glm::dvec3 irradiance{0};       ///< through clear air, on a surface that faces it
  double surfaceVisibility = 1.0; ///< the share that surfaces between let through
};

/// What of a light arrives at a place of the world, which is a point's of the map (latticePlace). Called from any
/// thread.
using ArrivalAt = std::function<Arrival(std::size_t point, const glm::dvec3& place)>;

/// What the light is in a volume, and how much of it the volume takes: numbers at the points of a lattice that reaches
/// from face to face of the unit cube, x fastest. Red, green and blue are the light that arrives, past surfaces and
/// through all media, in shares of `fullLight`. Alpha is the mean extinction that this volume alone has between the
/// point and where the ray towards the chosen light leaves it, in shares of `fullExtinction`: times the length of that
/// way, which is known for each point, it gives what is taken without any error in a homogeneous medium.
struct VolumeLight {
  glm::ivec3 size{0};            ///< points along each axis, at least 2
  std::vector<glm::vec4> texels; ///< 0..1, each number one that a 16-bit float can hold
  glm::dvec3 fullLight{0};
  double fullExtinction = 0; ///< per metre
  double milliseconds = 0;   ///< that making it took
};

struct VolumeLightInput {
  std::span<const Medium* const> media{}; ///< all of the frame
  std::size_t chosen = 0;                 ///< the one that gets its map
  std::span<const ArrivalAt> lights{};
  std::optional<glm::dvec3> towards{}; ///< the directional light whose share is kept in alpha; none = 0
  glm::ivec3 size{2};                  ///< at least 2 each
};

/// A point for each face between voxels, as far as there are no more than `most` along an axis. REQUIRES: most >= 2.
glm::ivec3 volumeLightSize(const DensityGrid& grid, int most = kMaxVolumeLightSide);

std::size_t pointsOf(const glm::ivec3& size);

/// Where a point of a map lies in the world; x fastest, then y, then z. REQUIRES: point < pointsOf(size).
glm::dvec3 latticePlace(const VolumeSpace& space, const glm::ivec3& size, std::size_t point);

/// By marching from each point to each light. A medium that casts no shadow dims nothing; one that receives none gets
/// the light as through clear air and past no surface.
VolumeLight makeVolumeLight(const VolumeLightInput& input);

/// What arrives at a place of the unit cube.
glm::dvec3 lightAt(const VolumeLight& map, const glm::dvec3& unit);

/// The share that the volume takes of the chosen light on its way to a place of the world: of all that is between there
/// and the light, inside of the volume or not. 0 where the ray towards the light does not meet the volume.
double shareTaken(const Medium& medium, const VolumeLight& map, const glm::dvec3& place, const glm::dvec3& towards);

struct MappedMedium {
  const Medium* medium = nullptr;
  const VolumeLight* map = nullptr;
};

/// The share of the chosen light that all of these let through to a place of the world: what a surface there gets is
/// this times what other surfaces let through.
double volumeVisibility(std::span<const MappedMedium> media, const glm::dvec3& place, const glm::dvec3& towards);

} // namespace gnomon
