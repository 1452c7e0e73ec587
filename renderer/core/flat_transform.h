#pragma once

#include <glm/glm.hpp>

namespace gnomon {

/// Whether a transform leaves nothing of a body's volume; so does one that is not finite.
bool isFlat(const glm::dmat4& matrix);

/// Whether a transform leaves not even a surface, but a line or a point; so does one that is not finite.
bool hasNoArea(const glm::dmat4& matrix);

} // namespace gnomon
