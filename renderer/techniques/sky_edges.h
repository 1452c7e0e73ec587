#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "renderer/core/vectors.h"
#include "renderer/techniques/sky_estimate.h"

namespace gnomon {

/// The share of an environment's light at every sample of a picture, from `even`, that of every pixel's first sample.
/// A sample that shows another triangle takes the mean of the pixels around that show its surface; where there are
/// none, 4 * `few` rays are sent from it, and counted in `sent`.
UnfilledVector<glm::u16vec4> sampleShares(const PicturePoints& points, const SkyLight& sky, const TracedSky& traced,
                                          std::uint32_t few, const UnfilledVector<glm::u16vec4>& even,
                                          std::uint64_t& sent);

} // namespace gnomon
