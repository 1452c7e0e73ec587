// Functions of sixteen numbers, with the names that GLSL has for them.
#if defined(GNOMON_CPU_FUNCTIONS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_CPU_FUNCTIONS_INL_H
#undef GNOMON_CPU_FUNCTIONS_INL_H
#else
#define GNOMON_CPU_FUNCTIONS_INL_H
#endif

#include <bit>
#include <cstdint>
#include <hwy/contrib/math/math-inl.h>

#include "renderer/cpu/lanes/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

HWY_INLINE Float abs(const Float& a) {
  GNOMON_EACH_PART(Float, r, hn::Abs(a.part[i]));
}
HWY_INLINE Float sqrt(const Float& a) {
  GNOMON_EACH_PART(Float, r, hn::Sqrt(a.part[i]));
}
inline constexpr std::int32_t kInverseRootGuess = 0x5f3759df; ///< less half of a number's bits

/// Newton's steps towards the inverse root of a number, from a guess.
template <class Number>
HWY_INLINE Number inverseRootFrom(Number root, const Number& a) {
  const Number half = a * -0.5f;
  for (int step = 0; step < 3; ++step) root = root * mulAdd(half * root, root, 1.5f);
  return root;
}
/// To within a few roundings, and without a division or a root, which take as long as twenty products: a guess by the
/// exponent, and Newton's steps from there (Lomont, "Fast Inverse Square Root", 2003). A large number, not infinity,
/// of 0.
HWY_INLINE Float inversesqrt(const Float& a) {
  return inverseRootFrom(floatOf(Int(kInverseRootGuess) - shiftRight<1>(bitsOf(a))), a);
}
/// Of one number, to the bit as of each of sixteen.
HWY_INLINE float inversesqrt(float a) {
  return inverseRootFrom(std::bit_cast<float>(kInverseRootGuess - (std::bit_cast<std::int32_t>(a) >> 1)), a);
}
HWY_INLINE Float floor(const Float& a) {
  GNOMON_EACH_PART(Float, r, hn::Floor(a.part[i]));
}
HWY_INLINE Float ceil(const Float& a) {
  GNOMON_EACH_PART(Float, r, hn::Ceil(a.part[i]));
}
HWY_INLINE Float fract(const Float& a) {
  return a - floor(a);
}
HWY_INLINE Float exp(const Float& a) {
  GNOMON_EACH_PART(Float, r, hn::Exp(kFloats, a.part[i]));
}
/// 2^a of -125..127, and of the nearer of these beyond: the series of the octave's rest, to within 3e-7 of itself.
HWY_INLINE Float exp2(const Float& a) {
  const Float within = min(max(a, -125.0f), 127.0f);
  constexpr float kWhole = 0x1.8p23f; // floats from there on are whole, and their lowest bits count on
  const Float octave = within + kWhole;
  const Float rest = within - (octave - kWhole);
  Float y = mulAdd(rest, 1.54035304e-4f, 1.33335581e-3f);
  y = mulAdd(y, rest, 9.61812911e-3f);
  y = mulAdd(y, rest, 5.55041087e-2f);
  y = mulAdd(y, rest, 0.240226507f);
  y = mulAdd(y, rest, 0.693147181f);
  y = mulAdd(y, rest, 1.0f);
  return floatOf(bitsOf(y) + shiftLeft<23>(bitsOf(octave)));
}
HWY_INLINE Float log2(const Float& a) {
  GNOMON_EACH_PART(Float, r, hn::Log2(kFloats, a.part[i]));
}
HWY_INLINE Float sin(const Float& a) {
  GNOMON_EACH_PART(Float, r, hn::Sin(kFloats, a.part[i]));
}
HWY_INLINE Float cos(const Float& a) {
  GNOMON_EACH_PART(Float, r, hn::Cos(kFloats, a.part[i]));
}

HWY_INLINE Float clamp(const Float& a, const Float& low, const Float& high) {
  return min(max(a, low), high);
}
HWY_INLINE Float mix(const Float& a, const Float& b, const Float& share) {
  return a * (1.0f - share) + b * share;
}
HWY_INLINE Float smoothstep(const Float& low, const Float& high, const Float& at) {
  const Float t = clamp((at - low) / (high - low), 0.0f, 1.0f);
  return t * t * (3.0f - 2.0f * t);
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
