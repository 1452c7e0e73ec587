// Some of sixteen numbers, stored one behind the other.
#if defined(GNOMON_CPU_PACKING_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_CPU_PACKING_INL_H
#undef GNOMON_CPU_PACKING_INL_H
#else
#define GNOMON_CPU_PACKING_INL_H
#endif

#include <array>
#include <bit>

#include "renderer/cpu/lanes/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

/// Of each set of a part's lanes, a bit each: its lanes in their order, then any. Highway's Compress has such a table,
/// too, which g++ copies whenever it is called.
inline constexpr auto kLanesOf = [] {
  std::array<std::array<std::uint8_t, 8>, 256> lanes{};
  for (std::size_t set = 0; set < lanes.size(); ++set) {
    std::size_t count = 0;
    for (std::uint8_t lane = 0; lane < 8; ++lane) {
      if ((set >> lane & 1) != 0) lanes[set][count++] = lane;
    }
  }
  return lanes;
}();

/// For any number of stores of the same lanes.
class Packing {
 public:
  HWY_INLINE explicit Packing(const Mask& where) {
    const unsigned bits = bitsOf(where);
    count_ = static_cast<std::size_t>(std::popcount(bits));
#if HWY_TARGET == HWY_AVX3
    where_ = where;
#else
    static_assert(kPerPart <= 8);
    constexpr unsigned kPart = (1u << kPerPart) - 1;
    constexpr hn::Rebind<std::uint8_t, IntTag> bytes;
    for (std::size_t i = 0; i < kParts; ++i) {
      const unsigned own = bits >> (i * kPerPart) & kPart;
      first_[i] = static_cast<std::size_t>(std::popcount(bits & ((1u << (i * kPerPart)) - 1)));
      from_[i] = hn::IndicesFromVec(kFloats, hn::PromoteTo(kInts, hn::LoadU(bytes, kLanesOf[own].data())));
    }
#endif
  }

  std::size_t count() const {
    return count_;
  }

  /// The lanes, and anything behind them, sixteen values at most.
  HWY_INLINE void store(const Float& a, float* to) const {
#if HWY_TARGET == HWY_AVX3
    hn::StoreU(hn::Compress(a.part[0], where_.part[0]), kFloats, to);
#else
    for (std::size_t i = 0; i < kParts; ++i)
      hn::StoreU(hn::TableLookupLanes(a.part[i], from_[i]), kFloats, to + first_[i]);
#endif
  }
  HWY_INLINE void store(const Int& a, std::int32_t* to) const {
    store(floatOf(a), reinterpret_cast<float*>(to));
  }
  HWY_INLINE void store(const Int& a, std::uint32_t* to) const {
    store(floatOf(a), reinterpret_cast<float*>(to));
  }

 private:
  std::size_t count_;
#if HWY_TARGET == HWY_AVX3
  Mask where_;
#else
  decltype(hn::IndicesFromVec(kFloats, hn::Zero(kInts))) from_[kParts];
  std::size_t first_[kParts];
#endif
};

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
