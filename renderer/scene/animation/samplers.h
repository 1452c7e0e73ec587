#pragma once

#include <compare>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "renderer/scene/animation/motion.h"
#include "renderer/scene/findings.h"
#include "renderer/scene/geometry/accessor_view.h"

namespace gnomon {

/// Of what kind a sampler's values are, and so of what type their accessor may be (glTF 2.0, 3.11).
enum class ValueKind {
  vector,   ///< floats
  rotation, ///< quaternions; floats, or what normalized integers come to
  numbers,  ///< floats, or what normalized integers come to
  boolean   ///< unsigned bytes, in steps
};

/// What a sampler's values are: it may serve several.
struct SamplerUse {
  ValueKind kind = ValueKind::vector;
  std::size_t components = 3; ///< of an element of the accessor
  std::size_t elements = 1;   ///< a keyframe

  auto operator<=>(const SamplerUse&) const = default;
};

/// Reads a sampler, at most `mostNumbers` of them; without times, and with a problem, where it breaks a rule.
Sampler buildSampler(const gltf::AnimationSampler& source, const std::string& pointer,
                     const std::vector<AccessorView>& accessors, const SamplerUse& use, std::size_t mostNumbers,
                     Findings& findings);

/// The numbers of a keyframe, `components` of them: of a cubic spline the middle row of three.
const float* valueOf(const Sampler& sampler, std::size_t keyframe);

/// The sampler's value at a time, `components` numbers; before the first and after the last keyframe that one's value
/// (glTF 2.0, 3.11 and appendix C). Rotations have length 1.
void sample(const Sampler& sampler, double timeSeconds, std::span<double> value);

} // namespace gnomon
