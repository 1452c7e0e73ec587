#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>

namespace gnomon::cpu {

inline constexpr std::size_t kSharedFunctionInputs = 16; ///< columns, from -1 to 1
inline constexpr std::size_t kSharedFunctionOutputs = 3;

/// The cases of shared_functions_cases.h by lanes, in `sharedFunctionNames`' order. `rows`: a multiple of 16.
void sharedFunctionByLanes(std::size_t which, std::size_t rows, const float* in, float* out);

/// An atlas of an environment: waves.
const glm::vec4* wavyEnvironment();

inline constexpr std::array sharedFunctionNames{"reflected",  "ambient",  "directional", "spot",    "point",
                                                "tone",       "caught",   "heat",        "glossy",  "octahedral",
                                                "by tangent", "by steps", "environment", "neutral", "agx"};

/// The cases in that order, as a list of what they are made of.
#define GNOMON_SHARED_FUNCTION_CASES                                                                            \
  Reflected, Ambient, Lamps, Arriving<GNOMON_DIRECTIONAL>, Arriving<GNOMON_SPOT>, Arriving<GNOMON_POINT>, Tone, \
      Caught, Heat, Glossy, Octahedral, ByTangent, BySteps, Environment, Mapped<GNOMON_TONE_NEUTRAL>,           \
      Mapped<GNOMON_TONE_AGX>

} // namespace gnomon::cpu
