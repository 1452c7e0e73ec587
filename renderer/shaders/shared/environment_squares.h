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
#define GNOMON_ENVIRONMENT_WIDTH 1026
#define GNOMON_ENVIRONMENT_HEIGHT 1284

// Of each square: the corner, without its border of one texel, and the side.
#define GNOMON_ENVIRONMENT_PLACES                                                                       \
  vec3(1, 1, 1024), vec3(1, 1027, 256), vec3(259, 1027, 128), vec3(389, 1027, 96), vec3(487, 1027, 64), \
      vec3(553, 1027, 48), vec3(603, 1027, 32), vec3(637, 1027, 24), vec3(259, 1157, 126)

#ifdef __cplusplus
namespace gnomon::shared {

using glm::vec3;

inline constexpr vec3 kEnvironmentSquares[] = {GNOMON_ENVIRONMENT_PLACES};

/// An atlas, row by row from the LOWEST: the place 0, 0 is its corner.
using EnvironmentTexels = const glm::vec4*;

} // namespace gnomon::shared
#endif
