// Where the maps of a prefiltered environment lie in their atlas (renderer/environment/prefilter.h).
#ifdef __cplusplus
#pragma once
#include <glm/glm.hpp>
#endif

// Levels of radiance: the number n is for a perceptual roughness of n / (levels - 1). Behind them: irradiance.
#define GNOMON_ENVIRONMENT_LEVELS 8
#define GNOMON_IRRADIANCE_SQUARE GNOMON_ENVIRONMENT_LEVELS
#define GNOMON_ENVIRONMENT_SQUARES (GNOMON_ENVIRONMENT_LEVELS + 1)

// Texels of the atlas.
#define GNOMON_ENVIRONMENT_WIDTH 514
#define GNOMON_ENVIRONMENT_HEIGHT 772

// Of each square: the corner, without its border of one texel, and the side.
#define GNOMON_ENVIRONMENT_PLACES                                                                                      \
  vec3(1, 1, 512), vec3(1, 515, 256), vec3(259, 515, 128), vec3(389, 515, 96), vec3(389, 613, 64), vec3(389, 679, 48), \
      vec3(455, 613, 32), vec3(455, 647, 24), vec3(259, 645, 126)

#ifdef __cplusplus
namespace gnomon::shared {

using glm::vec3;

inline constexpr vec3 kEnvironmentSquares[] = {GNOMON_ENVIRONMENT_PLACES};

/// An atlas, row by row from the LOWEST: the place 0, 0 is its corner.
using EnvironmentTexels = const glm::vec4*;

} // namespace gnomon::shared
#endif
