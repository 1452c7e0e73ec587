// Sixteen numbers at a time, whatever the processor: one vector of AVX-512, two of AVX2, four of SSE4 or NEON. Compiled
// once for each instruction set (Highway's foreach_target.h), so it has no include guard in the usual sense.
//
// Arithmetic is that of IEEE 754 binary32, an operation at a time: nothing is fused but what `mulAdd` fuses, and there
// are no approximate reciprocals. So a lane's result depends on its inputs and, by `mulAdd`, on the instruction set.
#if defined(GNOMON_CPU_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_CPU_LANES_INL_H
#undef GNOMON_CPU_LANES_INL_H
#else
#define GNOMON_CPU_LANES_INL_H
#endif

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <hwy/highway.h>
#include <limits>

#include "renderer/cpu/lanes/instruction_set.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

inline constexpr std::size_t kLanes = 16;
using FloatTag = hn::CappedTag<float, kLanes>;
using IntTag = hn::RebindToSigned<FloatTag>;
inline constexpr std::size_t kPerPart = hn::MaxLanes(FloatTag{});
inline constexpr std::size_t kParts = kLanes / kPerPart;
inline constexpr FloatTag kFloats{};
inline constexpr IntTag kInts{};

struct Float;
struct Int;

struct Mask {
  hn::Mask<FloatTag> part[kParts];
};

struct Float {
  hn::Vec<FloatTag> part[kParts];

  Float() = default;
  HWY_INLINE Float(float all) { // NOLINT(google-explicit-constructor): a number stands for sixteen
    for (auto& p : part) p = hn::Set(kFloats, all);
  }
};

struct Int {
  hn::Vec<IntTag> part[kParts];

  Int() = default;
  HWY_INLINE Int(std::int32_t all) { // NOLINT(google-explicit-constructor)
    for (auto& p : part) p = hn::Set(kInts, all);
  }
};

// For functions of lanes, here and in functions-inl.h.
#define GNOMON_EACH_PART(Type, result, expression)                      \
  Type result;                                                          \
  for (std::size_t i = 0; i < kParts; ++i) result.part[i] = expression; \
  return result

// Masks.
HWY_INLINE Mask operator&(const Mask& a, const Mask& b) {
  GNOMON_EACH_PART(Mask, r, hn::And(a.part[i], b.part[i]));
}
HWY_INLINE Mask operator|(const Mask& a, const Mask& b) {
  GNOMON_EACH_PART(Mask, r, hn::Or(a.part[i], b.part[i]));
}
HWY_INLINE Mask operator!(const Mask& a) {
  GNOMON_EACH_PART(Mask, r, hn::Not(a.part[i]));
}
HWY_INLINE Mask andNot(const Mask& without, const Mask& a) {
  GNOMON_EACH_PART(Mask, r, hn::AndNot(without.part[i], a.part[i]));
}
HWY_INLINE bool any(const Mask& a) {
  bool found = false;
  for (const auto& p : a.part) found |= !hn::AllFalse(kFloats, p);
  return found;
}
HWY_INLINE bool none(const Mask& a) {
  return !any(a);
}
HWY_INLINE bool all(const Mask& a) {
  return none(!a);
}

/// A bit a lane, lane 0 lowest.
HWY_INLINE unsigned bitsOf(const Mask& a) {
  unsigned bits = 0;
  for (std::size_t i = 0; i < kParts; ++i) {
    alignas(8) std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(kFloats, a.part[i], bytes);
    bits |= (bytes[0] | static_cast<unsigned>(bytes[1]) << 8) << (i * kPerPart);
  }
  return bits;
}
HWY_INLINE Mask maskOf(unsigned bits) {
  Mask r;
  for (std::size_t i = 0; i < kParts; ++i) {
    const unsigned own = bits >> (i * kPerPart);
    alignas(8) const std::uint8_t bytes[8] = {static_cast<std::uint8_t>(own), static_cast<std::uint8_t>(own >> 8)};
    r.part[i] = hn::LoadMaskBits(kFloats, bytes);
  }
  return r;
}
HWY_INLINE Mask firstLanes(std::size_t count) {
  return maskOf((1u << count) - 1u);
}

// Memory. `from` and `to` hold 16 values. What lies elsewhere: gather-inl.h.
HWY_INLINE Float load(const float* from) {
  GNOMON_EACH_PART(Float, r, hn::LoadU(kFloats, from + i * kPerPart));
}
HWY_INLINE Int load(const std::int32_t* from) {
  GNOMON_EACH_PART(Int, r, hn::LoadU(kInts, from + i * kPerPart));
}
HWY_INLINE Int load(const std::uint32_t* from) {
  return load(reinterpret_cast<const std::int32_t*>(from));
}
HWY_INLINE void store(const Float& a, float* to) {
  for (std::size_t i = 0; i < kParts; ++i) hn::StoreU(a.part[i], kFloats, to + i * kPerPart);
}
HWY_INLINE void store(const Int& a, std::int32_t* to) {
  for (std::size_t i = 0; i < kParts; ++i) hn::StoreU(a.part[i], kInts, to + i * kPerPart);
}
HWY_INLINE void store(const Int& a, std::uint32_t* to) {
  store(a, reinterpret_cast<std::int32_t*>(to));
}
/// 0, 1, ... 15.
HWY_INLINE Int laneNumbers() {
  GNOMON_EACH_PART(Int, r, hn::Iota(kInts, static_cast<std::int32_t>(i * kPerPart)));
}

// Conversions. A float that no int holds becomes some int.
HWY_INLINE Float toFloat(const Int& a) {
  GNOMON_EACH_PART(Float, r, hn::ConvertTo(kFloats, a.part[i]));
}
HWY_INLINE Int truncated(const Float& a) {
  GNOMON_EACH_PART(Int, r, hn::ConvertTo(kInts, a.part[i]));
}
HWY_INLINE Int nearest(const Float& a) {
  GNOMON_EACH_PART(Int, r, hn::NearestInt(a.part[i]));
}
HWY_INLINE Int bitsOf(const Float& a) {
  GNOMON_EACH_PART(Int, r, hn::BitCast(kInts, a.part[i]));
}
HWY_INLINE Float floatOf(const Int& bits) {
  GNOMON_EACH_PART(Float, r, hn::BitCast(kFloats, bits.part[i]));
}

#define GNOMON_BINARY(Type, name, function)                        \
  HWY_INLINE Type name(const Type& a, const Type& b) {             \
    GNOMON_EACH_PART(Type, r, hn::function(a.part[i], b.part[i])); \
  }
GNOMON_BINARY(Float, operator+, Add)
GNOMON_BINARY(Float, operator-, Sub)
GNOMON_BINARY(Float, operator*, Mul)
GNOMON_BINARY(Float, operator/, Div)
GNOMON_BINARY(Float, min, Min)
GNOMON_BINARY(Float, max, Max)
GNOMON_BINARY(Int, operator+, Add)
GNOMON_BINARY(Int, operator-, Sub)
GNOMON_BINARY(Int, operator*, Mul)
GNOMON_BINARY(Int, operator&, And)
GNOMON_BINARY(Int, operator|, Or)
GNOMON_BINARY(Int, operator^, Xor)
GNOMON_BINARY(Int, min, Min)
GNOMON_BINARY(Int, max, Max)
#undef GNOMON_BINARY

HWY_INLINE Float operator-(const Float& a) {
  GNOMON_EACH_PART(Float, r, hn::Neg(a.part[i]));
}
HWY_INLINE Float& operator+=(Float& a, const Float& b) {
  return a = a + b;
}
HWY_INLINE Float& operator-=(Float& a, const Float& b) {
  return a = a - b;
}
HWY_INLINE Float& operator*=(Float& a, const Float& b) {
  return a = a * b;
}
HWY_INLINE Float& operator/=(Float& a, const Float& b) {
  return a = a / b;
}

HWY_INLINE std::int32_t firstLane(const Int& a) {
  return hn::GetLane(a.part[0]);
}
HWY_INLINE float firstLane(const Float& a) {
  return hn::GetLane(a.part[0]);
}

/// Of all lanes.
HWY_INLINE float leastLane(const Float& a) {
  auto least = a.part[0];
  for (std::size_t i = 1; i < kParts; ++i) least = hn::Min(least, a.part[i]);
  return hn::GetLane(hn::MinOfLanes(kFloats, least));
}
HWY_INLINE float greatestLane(const Float& a) {
  auto greatest = a.part[0];
  for (std::size_t i = 1; i < kParts; ++i) greatest = hn::Max(greatest, a.part[i]);
  return hn::GetLane(hn::MaxOfLanes(kFloats, greatest));
}

HWY_INLINE std::int32_t leastLane(const Int& a) {
  auto least = a.part[0];
  for (std::size_t i = 1; i < kParts; ++i) least = hn::Min(least, a.part[i]);
  return hn::GetLane(hn::MinOfLanes(kInts, least));
}
HWY_INLINE std::int32_t greatestLane(const Int& a) {
  auto greatest = a.part[0];
  for (std::size_t i = 1; i < kParts; ++i) greatest = hn::Max(greatest, a.part[i]);
  return hn::GetLane(hn::MaxOfLanes(kInts, greatest));
}

template <int bits>
HWY_INLINE Int shiftLeft(const Int& a) {
  GNOMON_EACH_PART(Int, r, hn::ShiftLeft<bits>(a.part[i]));
}
/// Of the sign's copies.
template <int bits>
HWY_INLINE Int shiftRight(const Int& a) {
  GNOMON_EACH_PART(Int, r, hn::ShiftRight<bits>(a.part[i]));
}
/// Of zeros.
template <int bits>
HWY_INLINE Int shiftRightUnsigned(const Int& a) {
  constexpr hn::RebindToUnsigned<IntTag> unsignedInts;
  GNOMON_EACH_PART(Int, r, hn::BitCast(kInts, hn::ShiftRight<bits>(hn::BitCast(unsignedInts, a.part[i]))));
}

#define GNOMON_COMPARE(name, function)                                                      \
  HWY_INLINE Mask name(const Float& a, const Float& b) {                                    \
    GNOMON_EACH_PART(Mask, r, hn::function(a.part[i], b.part[i]));                          \
  }                                                                                         \
  HWY_INLINE Mask name(const Int& a, const Int& b) {                                        \
    GNOMON_EACH_PART(Mask, r, hn::RebindMask(kFloats, hn::function(a.part[i], b.part[i]))); \
  }
GNOMON_COMPARE(operator<, Lt)
GNOMON_COMPARE(operator>, Gt)
GNOMON_COMPARE(operator==, Eq)
GNOMON_COMPARE(operator!=, Ne)
#undef GNOMON_COMPARE
HWY_INLINE Mask operator<=(const Float& a, const Float& b) {
  GNOMON_EACH_PART(Mask, r, hn::Le(a.part[i], b.part[i]));
}
HWY_INLINE Mask operator>=(const Float& a, const Float& b) {
  GNOMON_EACH_PART(Mask, r, hn::Ge(a.part[i], b.part[i]));
}
HWY_INLINE Mask operator<=(const Int& a, const Int& b) {
  return !(a > b);
}
HWY_INLINE Mask operator>=(const Int& a, const Int& b) {
  return !(a < b);
}

HWY_INLINE Float select(const Mask& where, const Float& yes, const Float& no) {
  GNOMON_EACH_PART(Float, r, hn::IfThenElse(where.part[i], yes.part[i], no.part[i]));
}
HWY_INLINE Int select(const Mask& where, const Int& yes, const Int& no) {
  GNOMON_EACH_PART(Int, r, hn::IfThenElse(hn::RebindMask(kInts, where.part[i]), yes.part[i], no.part[i]));
}

/// Of the lanes `where`, of which there are some.
HWY_INLINE float leastOf(const Mask& where, const Float& a) {
  return leastLane(select(where, a, std::numeric_limits<float>::max()));
}
HWY_INLINE float mostOf(const Mask& where, const Float& a) {
  return greatestLane(select(where, a, std::numeric_limits<float>::lowest()));
}
HWY_INLINE std::int32_t leastOf(const Mask& where, const Int& a) {
  return leastLane(select(where, a, std::numeric_limits<std::int32_t>::max()));
}
HWY_INLINE std::int32_t mostOf(const Mask& where, const Int& a) {
  return greatestLane(select(where, a, std::numeric_limits<std::int32_t>::min()));
}

/// a * b + c, rounded once where the processor can.
HWY_INLINE Float mulAdd(const Float& a, const Float& b, const Float& c) {
  GNOMON_EACH_PART(Float, r, hn::MulAdd(a.part[i], b.part[i], c.part[i]));
}
HWY_INLINE float mulAdd(float a, float b, float c) {
#if HWY_NATIVE_FMA
  return __builtin_fmaf(a, b, c);
#else
  return a * b + c;
#endif
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
