#pragma once

#include <glm/glm.hpp>

#include "protocol/spec/light.h"

namespace gnomon {

/// Where the light travels, unit length, from `direction` or `sun`; for a point light it means nothing.
glm::dvec3 directionOf(const Light& light);

} // namespace gnomon
