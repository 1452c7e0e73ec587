#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "renderer/environment/frame_sampler.h"
#include "renderer/rays/sky_rays.h"
#include "renderer/volume/volume_light.h"

/// How much of an environment reaches the places of a volume.
namespace gnomon {

/// Directions that stand for an environment at every place, and the light from each.
struct DirectionsOfSky {
  std::vector<glm::dvec3> towards; ///< unit length, in the world
  std::vector<glm::dvec3> light;   ///< linear RGB; the more the fewer directions are near
};

/// So many directions, evenly over the sphere and, where the radiance varies much, by where light comes from; both
/// kinds count as the balance heuristic says (Veach and Guibas, 1995). Those without light are left out.
DirectionsOfSky skyDirections(const SkyLight& sky, int count);

inline constexpr int kMostSkySide = 32; ///< points of a volume along each axis, where rays look for its sky

/// How many directions a place of a volume looks into, for the `samples` of an environment.
int skyDirectionCount(int samples);

/// The environment's radiance, the mean over all directions, that arrives at the points of a lattice in a volume:
/// `open` of it where nothing hides any, so that an open place has no noise. `size`: of the volume's light map; the
/// lattice has as many points up to kMostSkySide. Alpha is 0.
VolumeLight skyInVolume(const TracedSky& traced, const DirectionsOfSky& sky, const glm::dvec3& open,
                        const VolumeSpace& space, const glm::ivec3& size);

/// The same where nothing hides any.
VolumeLight openSky(const glm::dvec3& open);

} // namespace gnomon
