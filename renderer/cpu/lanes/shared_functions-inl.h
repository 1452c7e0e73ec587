// What shaders compute from shared texts (renderer/shaders/shared/functions.h), sixteen numbers at a time.
#if defined(GNOMON_CPU_SHARED_FUNCTIONS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_CPU_SHARED_FUNCTIONS_INL_H
#undef GNOMON_CPU_SHARED_FUNCTIONS_INL_H
#else
#define GNOMON_CPU_SHARED_FUNCTIONS_INL_H
#endif

#include "renderer/cpu/lanes/gather-inl.h"
#include "renderer/cpu/lanes/vectors-inl.h"
#include "renderer/shaders/shared/environment_squares.h"
#include "renderer/shaders/shared/frame_types.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

using Real = Float;
using Whole = Int;
using Truth = Mask;
using vec2 = Float2;
using vec3 = Float3;
using vec4 = Float4;
using shared::FrameData;
using shared::LightData;
using shared::TileData;

HWY_INLINE Mask both(const Mask& a, const Mask& b) {
  return a & b;
}

/// A row of an affine matrix times points.
HWY_INLINE Float along(const glm::vec4& row, const Float3& place) {
  return mulAdd(place.x, row.x, mulAdd(place.y, row.y, mulAdd(place.z, row.z, row.w)));
}

using shared::EnvironmentTexels;

HWY_INLINE Float3 environmentSquare(const Float& number) {
  const float* squares = &shared::kEnvironmentSquares[0].x;
  const Int at = truncated(number) * Int(3);
  return {gather(squares, at), gather(squares, at + Int(1)), gather(squares, at + Int(2))};
}

/// Lanes that show nothing may ask for any place, and get any texel.
HWY_INLINE Float3 environmentTexel(EnvironmentTexels texels, const Float2& place) {
  const Float fromX = floor(place.x - 0.5f), fromY = floor(place.y - 0.5f);
  const Float shareX = place.x - 0.5f - fromX, shareY = place.y - 0.5f - fromY;
  const Int column = min(max(truncated(fromX), Int(0)), Int(GNOMON_ENVIRONMENT_WIDTH - 2));
  const Int row = min(max(truncated(fromY), Int(0)), Int(GNOMON_ENVIRONMENT_HEIGHT - 2));
  const Int first = (row * Int(GNOMON_ENVIRONMENT_WIDTH) + column) * Int(4);
  const Int next = first + Int(4 * GNOMON_ENVIRONMENT_WIDTH);
  const auto between = [&](const Int& at) HWY_ATTR {
    Float left[4], right[4];
    gatherFours(&texels->x, at, left);
    gatherFours(&texels->x, at + Int(4), right);
    return mix(Float3(left[0], left[1], left[2]), Float3(right[0], right[1], right[2]), shareX);
  };
  return mix(between(first), between(next), shareY);
}

#define GNOMON_FUNCTION HWY_INLINE
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

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
