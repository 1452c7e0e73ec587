// What shaders compute from shared texts (renderer/shaders/shared/functions.h), sixteen numbers at a time.
#if defined(GNOMON_CPU_SHARED_FUNCTIONS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_CPU_SHARED_FUNCTIONS_INL_H
#undef GNOMON_CPU_SHARED_FUNCTIONS_INL_H
#else
#define GNOMON_CPU_SHARED_FUNCTIONS_INL_H
#endif

#include "renderer/cpu/lanes/vectors-inl.h"
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

#define GNOMON_FUNCTION HWY_INLINE
#define GNOMON_CONSTANT(name, value) inline constexpr float name = value
#define GNOMON_OUT(type) type&
#define PUNCTUAL
#define MANUAL_BIAS
#include "renderer/shaders/shared/surroundings.h"
// brdf.h calls what surroundings.h defines.
#include "renderer/shaders/shared/brdf.h"
#include "renderer/shaders/shared/light.h"
#include "renderer/shaders/shared/moments.h"
#include "renderer/shaders/shared/normal_map.h"
#include "renderer/shaders/shared/octahedral.h"
#include "renderer/shaders/shared/picture.h"
#include "renderer/shaders/shared/shadow_bias.h"
// debug_light.h calls what shadow_bias.h defines.
#include "renderer/shaders/shared/debug_light.h"
// shadow_catcher.h calls what surroundings.h, brdf.h and picture.h define.
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
