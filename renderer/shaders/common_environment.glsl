// The light around the scene: of an environment, or the studio. After the frame buffer; with ENVIRONMENT, after
// ENVIRONMENT_UNIT too, where its atlas is bound, read with linear filters.
#include "shared/surroundings.h"
#include "shared/octahedral.h"
#include "shared/brdf.h"
#include "shared/reflected_around.h"
#ifdef ENVIRONMENT
#include "shared/environment_squares.h"
#define EnvironmentTexels sampler2D

layout(binding = ENVIRONMENT_UNIT) uniform sampler2D environmentTexels;

const vec3 kEnvironmentSquares[GNOMON_ENVIRONMENT_SQUARES] = vec3[](GNOMON_ENVIRONMENT_PLACES);

vec3 environmentSquare(float number) { return kEnvironmentSquares[int(number)]; }

vec3 environmentTexel(sampler2D texels, vec2 place) {
  return textureLod(texels, place / vec2(GNOMON_ENVIRONMENT_WIDTH, GNOMON_ENVIRONMENT_HEIGHT), 0.0).rgb;
}
#include "shared/environment.h"
#endif

// Their irradiance over pi on what faces a world direction.
vec3 irradianceOfSurroundings(vec3 normal) {
#ifdef ENVIRONMENT
  vec3 texel = environmentIrradiance(environmentTexels, inEnvironment(normal, frame.environmentTurn));
  return frame.environmentIntensity * texel;
#else
  return frame.ambient * irradianceOfStudio(normal, frame.environmentTurn, frame.studioLamps);
#endif
}

// Their radiance from a world direction. `roughness`: perceptual, of the surface that shows it.
vec3 radianceOfSurroundings(vec3 direction, float roughness) {
#ifdef ENVIRONMENT
  vec3 texel = environmentRadiance(environmentTexels, inEnvironment(direction, frame.environmentTurn), roughness);
  return frame.environmentIntensity * texel;
#else
  return frame.ambient * radianceOfStudio(direction, frame.environmentTurn, frame.studioLamps, roughness);
#endif
}
