// Moments of the depths in a blurred shadow map, by the filter's kind, and the light that they let through:
// shaders/common_moments.glsl, sixteen at a time. Depth is 0 nearest the light and 1 farthest, linear in distance.
#if defined(GNOMON_CPU_MOMENTS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_CPU_MOMENTS_INL_H
#undef GNOMON_CPU_MOMENTS_INL_H
#else
#define GNOMON_CPU_MOMENTS_INL_H
#endif

#include "renderer/cpu/lanes/vectors-inl.h"
#include "renderer/shaders/shared/frame_types.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

inline constexpr float kPositiveExponent = 40.0f; // of a depth in -1..1: its square still fits a float
inline constexpr float kNegativeExponent = 5.0f;
/// Light that leaks into a shadow under a second caster is cut: shares below this are none.
/// (Lauritzen, "Summed-Area Variance Shadow Maps", GPU Gems 3, 2007, section 8.4.3.)
inline constexpr float kBleeding = 0.2f;

struct Moments {
  Float x, y, z, w;
};

HWY_INLINE Float2 warped(const Float& depth) {
  const Float z = 2.0f * depth - 1.0f;
  return {exp(kPositiveExponent * z), -exp(-kNegativeExponent * z)};
}

/// `kind`: GNOMON_FILTER_..., as below.
HWY_INLINE Moments momentsOf(const Float& depth, int kind) {
  if (kind == GNOMON_FILTER_VSM) {
    const Float z = depth - 0.5f; // centred: the squares keep more digits
    return {z, z * z, 0.0f, 0.0f};
  }
  if (kind == GNOMON_FILTER_EVSM) {
    const Float2 w = warped(depth);
    return {w.x, w.x * w.x, w.y, w.y * w.y};
  }
  const Float z = 2.0f * depth - 1.0f;
  const Float squared = z * z;
  return {z, squared, squared * z, squared * z * z};
}

/// The greatest share of a distribution that may lie at or beyond `depth`: Chebyshev's inequality, one tail.
/// (Donnelly, Lauritzen, "Variance Shadow Maps", I3D 2006.)
HWY_INLINE Float chebyshev(const Float& mean, const Float& square, const Float& depth, const Float& leastVariance) {
  const Float variance = max(square - mean * mean, leastVariance);
  const Float beyond = depth - mean;
  return select(depth <= mean, 1.0f, variance / (variance + beyond * beyond));
}

/// The least share that lies before `depth`, from four moments: the three-point distribution with a point at `depth`
/// that has these moments. (Peters, Klein, "Moment Shadow Mapping", I3D 2015; the bias for 32-bit floats and depths in
/// -1..1 from Peters et al., "Improved Moment Shadow Maps", JCGT 2017.)
inline Float hamburger(const Moments& moments, const Float& depth) {
  constexpr float bias = 3e-7f;
  const Float mx = mix(moments.x, 0.0f, bias);
  const Float my = mix(moments.y, 0.375f, bias);
  const Float mz = mix(moments.z, 0.0f, bias);
  const Float mw = mix(moments.w, 0.375f, bias);
  // Solve H x = (1, depth, depth^2), H the Hankel matrix of the moments, by H = L D L^T.
  const Float d1 = max(my - mx * mx, 1e-12f);
  const Float l21 = (mz - mx * my) / d1;
  const Float d2 = max(mw - my * my - l21 * l21 * d1, 1e-12f);
  const Float y1 = depth - mx;
  const Float y2 = depth * depth - my - l21 * y1;
  const Float x2 = y2 / d2;
  const Float x1 = y1 / d1 - l21 * x2;
  const Float x0 = 1.0f - mx * x1 - my * x2;
  // The other two points: the roots of x0 + x1 z + x2 z^2.
  const Float half = -0.5f * x1 / x2;
  const Float spread = sqrt(max(half * half - x0 / x2, 0.0f));
  const Float low = half - spread;
  const Float high = half + spread;
  const Float between = (depth * high - mx * (depth + high) + my) / ((high - low) * (depth - low));
  const Float beyond = 1.0f - (low * high - mx * (low + high) + my) / ((depth - low) * (depth - high));
  const Float share = clamp(select(depth <= high, between, beyond), 0.0f, 1.0f);
  return select(depth <= low, 0.0f, share);
}

HWY_INLINE Float withoutBleeding(const Float& share) {
  return clamp((share - kBleeding) / (1.0f - kBleeding), 0.0f, 1.0f);
}

/// Share of the light that arrives at `depth`.
inline Float visibilityFrom(const Moments& moments, const Float& depth, int kind) {
  if (kind == GNOMON_FILTER_VSM) return withoutBleeding(chebyshev(moments.x, moments.y, depth - 0.5f, 1e-7f));
  if (kind == GNOMON_FILTER_EVSM) {
    // (Lauritzen, McCool, "Layered Variance Shadow Maps", GI 2008; least variance: 1e-4 of the depth, warped.)
    const Float2 w = warped(depth);
    const Float2 least = 1e-4f * (Float2(kPositiveExponent, kNegativeExponent) * w);
    return withoutBleeding(min(chebyshev(moments.x, moments.y, w.x, least.x * least.x),
                               chebyshev(moments.z, moments.w, w.y, least.y * least.y)));
  }
  return withoutBleeding(1.0f - hamburger(moments, 2.0f * depth - 1.0f));
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
