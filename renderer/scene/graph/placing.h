#pragma once

#include <glm/glm.hpp>

#include "renderer/core/aabb.h"

namespace gnomon {

/// Whether a transform leaves nothing of a body's volume; so does one that is not finite.
bool isFlat(const glm::dmat4& matrix);

bool finite(const Aabb& box);

} // namespace gnomon
