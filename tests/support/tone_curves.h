#pragma once

#include <glm/glm.hpp>

#include "protocol/spec/output_options.h"

namespace gnomon::testing {

/// What tone mappings are published to give, in double precision: linear light in, linear colors of 0..1 out. aces has
/// no such text and is a problem here.
glm::dvec3 publishedTone(ToneMapping tone, const glm::dvec3& light);

/// The byte of a linear color: IEC 61966-2-1.
int srgbByte(double linear);

} // namespace gnomon::testing
