#pragma once

#include <glm/glm.hpp>

#include "protocol/base/result.h"
#include "renderer/environment/environment_map.h"

/// What a picture must be to light a scene. Problems have no pointer.
namespace gnomon {

/// Its sides are within the limits, and the width is twice the height.
Status checkEnvironmentSize(const glm::ivec2& size);

/// Every number is finite, not negative and at most kLimits.maxRadiance: else a problem that names the first texel
/// that breaks this, as "column, row" from the upper left corner.
Status checkEnvironmentTexels(const EnvironmentMap& map);

} // namespace gnomon
