#pragma once

#include <array>
#include <optional>

#include "renderer/bake/light_map.h"
#include "renderer/bake/light_map_layout.h"
#include "renderer/core/stop.h"
#include "renderer/environment/frame_sampler.h"
#include "renderer/rays/trace.h"

namespace gnomon {

/// Rays that a texel sends to an environment for each of its `samples`: a picture's pixels share theirs with those
/// around them, a texel has but its own.
inline constexpr int kEnvironmentRaysOfSample = 64;

/// What share of an environment's light arrives on the front of each texel that a surface covers, where it is reflected
/// diffusely: red, green and blue. Rays go by the cosine and by where light comes from, as in pictures
/// (renderer/techniques/sky_estimate.h), and are even over each texel. A ratio of what arrives and of what would arrive
/// without casters: where nothing is hidden it is 1, without noise; 1 too where nothing shines, or where the surface
/// shows no shadows. What no surface covers takes on what lies nearest in its chart. The camera and the lights of
/// `rays` do not matter. The same for any number of threads. Nothing where `progress` asks to stop.
std::optional<std::array<LightMap, 3>> bakeEnvironment(const TraceInput& rays, const SkyLight& sky,
                                                       const LightMapLayout& layout, int samples,
                                                       const Progress& progress);

} // namespace gnomon
