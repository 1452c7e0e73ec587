#pragma once

#include <span>

#include "renderer/environment/frame_sampler.h"
#include "renderer/rays/sky_rays.h"
#include "renderer/reference/reference.h"

namespace gnomon {

/// Adds the next points to what is known of an environment: the share of its diffuse light that arrives there, by
/// luminance. `samples`: rays a point at least, stratified by the cosine, and as many by where light comes from where
/// that varies much.
void traceEnvironment(const TracedSky& traced, const SkyLight& sky, std::span<const SurfacePoint> points, int samples,
                      LightReference& light);

} // namespace gnomon
