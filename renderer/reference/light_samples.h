#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "renderer/reference/trace.h"

namespace gnomon {

/// Number `index` of `count` places in the unit disc, spread evenly over its area for any count. `seed` shifts them.
glm::dvec2 discSample(std::uint32_t index, std::uint32_t count, std::uint64_t seed);

/// From what the point is, and not from where it stands in a list: it gets the same samples every time.
std::uint64_t seedOf(const SurfacePoint& point);

} // namespace gnomon
