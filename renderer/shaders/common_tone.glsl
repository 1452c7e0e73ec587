#include "common_names.glsl"
#include "shared/tone.h"

#ifdef TONE_ACES
vec3 toneMapped(vec3 radiance) { return acesToneMapped(radiance); }
#elif defined(TONE_CLIP)
vec3 toneMapped(vec3 radiance) { return clippedTone(radiance); }
#else
vec3 toneMapped(vec3 radiance) { return radiance; }
#endif
