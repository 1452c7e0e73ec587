#pragma once

#include <cstddef>
#include <span>

#include "renderer/scene/animation/motion.h"

namespace gnomon {

/// The numbers of a keyframe, `components` of them: of a cubic spline the middle row of three.
const float* valueOf(const Sampler& sampler, std::size_t keyframe);

/// The sampler's value at a time, `components` numbers; before the first and after the last keyframe that one's value
/// (glTF 2.0, 3.11 and appendix C). Rotations have length 1.
void sample(const Sampler& sampler, double timeSeconds, std::span<double> value);

} // namespace gnomon
