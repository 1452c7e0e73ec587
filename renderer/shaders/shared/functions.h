#pragma once

#include <glm/glm.hpp>

#include "renderer/shaders/shared/environment_squares.h"
#include "renderer/shaders/shared/frame_types.h"

/// What shaders and C++ both compute, from one text, here a number at a time. The texts use what GLSL and GLM both have
/// and these names: `Real`, a number; `Whole`, an integer; `Truth`, a condition; `select(condition, yes, no)`, where
/// numbers may differ in the condition; `both(a, b)`; `along(row, place)`. They branch only on what is the same for a
/// whole frame, light or material, so that C++ may take them with many numbers at once
/// (renderer/cpu/lanes/shared_functions-inl.h).
namespace gnomon::shared {

using glm::abs;
using glm::clamp;
using glm::cross;
using glm::dot;
using glm::exp;
using glm::exp2;
using glm::floor;
using glm::fract;
using glm::inversesqrt;
using glm::length;
using glm::log2;
using glm::max;
using glm::min;
using glm::mix;
using glm::normalize;
using glm::reflect;
using glm::smoothstep;
using glm::sqrt;

using Real = float;
using Whole = int;
using Truth = bool;

template <class T>
T select(bool condition, const T& yes, const T& no) {
  return condition ? yes : no;
}

inline bool both(bool a, bool b) {
  return a && b;
}

/// A row of an affine matrix times a point.
inline float along(const vec4& row, const vec3& place) {
  return dot(row, vec4(place, 1.0f));
}

inline vec3 environmentSquare(float number) {
  return kEnvironmentSquares[static_cast<int>(number)];
}

inline vec3 environmentTexel(EnvironmentTexels texels, const vec2& place) {
  const vec2 from = floor(place - 0.5f);
  const vec2 share = place - 0.5f - from;
  const vec4* first = texels + static_cast<int>(from.y) * GNOMON_ENVIRONMENT_WIDTH + static_cast<int>(from.x);
  const vec4* next = first + GNOMON_ENVIRONMENT_WIDTH;
  return vec3(mix(mix(first[0], first[1], share.x), mix(next[0], next[1], share.x), share.y));
}

#define GNOMON_FUNCTION inline
#define GNOMON_CONSTANT(name, value) inline constexpr float name = value
#define GNOMON_OUT(type) type&
#define PUNCTUAL
#define MANUAL_BIAS
#include "renderer/shaders/shared/brdf.h"
#include "renderer/shaders/shared/light.h"
#include "renderer/shaders/shared/moments.h"
#include "renderer/shaders/shared/normal_map.h"
#include "renderer/shaders/shared/octahedral.h"
#include "renderer/shaders/shared/surroundings.h"
// reflected_around.h calls what brdf.h and surroundings.h define.
#include "renderer/shaders/shared/reflected_around.h"
// environment.h calls what octahedral.h and the two above define.
#include "renderer/shaders/shared/environment.h"
#include "renderer/shaders/shared/picture.h"
#include "renderer/shaders/shared/shadow_bias.h"
// debug_light.h calls what shadow_bias.h defines.
#include "renderer/shaders/shared/debug_light.h"
// shadow_catcher.h calls what brdf.h and picture.h define.
#include "renderer/shaders/shared/shadow_catcher.h"
#include "renderer/shaders/shared/shadow_disc.h"
#include "renderer/shaders/shared/smooth_surface.h"
#include "renderer/shaders/shared/specular_glossiness.h"
#include "renderer/shaders/shared/tile_choice.h"
#undef MANUAL_BIAS
#undef PUNCTUAL
#undef GNOMON_OUT
#undef GNOMON_CONSTANT
#undef GNOMON_FUNCTION

} // namespace gnomon::shared
