// Numbers that do not lie as sixteen lanes do: from anywhere in memory, or several that belong together side by side.
#if defined(GNOMON_CPU_GATHER_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_CPU_GATHER_INL_H
#undef GNOMON_CPU_GATHER_INL_H
#else
#define GNOMON_CPU_GATHER_INL_H
#endif

#include "renderer/cpu/lanes/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

// A gather reads base[index].
HWY_INLINE Float gather(const float* base, const Int& index) {
  GNOMON_EACH_PART(Float, r, hn::GatherIndex(kFloats, base, index.part[i]));
}
HWY_INLINE Int gather(const std::int32_t* base, const Int& index) {
  GNOMON_EACH_PART(Int, r, hn::GatherIndex(kInts, base, index.part[i]));
}
HWY_INLINE Int gather(const std::uint32_t* base, const Int& index) {
  return gather(reinterpret_cast<const std::int32_t*>(base), index);
}
/// Reads whole pairs: numbers 0 and 1, 2 and 3 and so on have to be there together.
HWY_INLINE Int gather(const std::uint16_t* base, const Int& index) {
  const auto* pairs = reinterpret_cast<const std::int32_t*>(base);
  GNOMON_EACH_PART(Int, r,
                   hn::And(hn::Shr(hn::GatherIndex(kInts, pairs, hn::ShiftRight<1>(index.part[i])),
                                   hn::ShiftLeft<4>(hn::And(index.part[i], hn::Set(kInts, 1)))),
                           hn::Set(kInts, 0xffff)));
}
/// Number `index` in the lower half, and the one behind it in the upper.
HWY_INLINE Int gatherPairs(const std::uint16_t* base, const Int& index) {
#if HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX2
  const auto* pairs = reinterpret_cast<const std::int32_t*>(base);
  GNOMON_EACH_PART(Int, r, hn::GatherOffset(kInts, pairs, hn::ShiftLeft<1>(index.part[i])));
#else
  alignas(64) std::int32_t lanes[kLanes];
  store(index, lanes);
  for (std::int32_t& lane : lanes) std::memcpy(&lane, base + lane, sizeof lane);
  return load(lanes);
#endif
}
/// Four rows of four numbers, each row `stride` numbers behind the one before.
HWY_INLINE Int loadRows(const std::uint16_t* first, std::size_t stride) {
  alignas(32) std::uint16_t rows[kLanes];
  for (std::size_t row = 0; row < 4; ++row) std::memcpy(rows + 4 * row, first + row * stride, 4 * sizeof *rows);
  constexpr hn::Rebind<std::uint16_t, IntTag> words;
  GNOMON_EACH_PART(Int, r, hn::PromoteTo(kInts, hn::Load(words, rows + i * kPerPart)));
}
/// A vector of the blocks of sixteen bytes that `read(i)` gives.
template <class Tag, class Read>
HWY_INLINE hn::Vec<Tag> eachBlock(Tag tag, const Read& read) {
#if HWY_MAX_BYTES >= 64
  constexpr hn::Half<Tag> half;
  return hn::Combine(tag, hn::Combine(half, read(3), read(2)), hn::Combine(half, read(1), read(0)));
#elif HWY_MAX_BYTES == 32
  return hn::Combine(tag, read(1), read(0));
#else
  (void)tag;
  return read(0);
#endif
}
/// Two numbers for each lane, base[index] and the one behind it. They are read far sooner than by two gathers.
HWY_INLINE void gatherTwos(const std::uint32_t* base, const Int& index, Int& first, Int& second) {
  constexpr hn::Full64<std::int32_t> pair;
  constexpr hn::Full128<std::int32_t> quad;
  alignas(64) std::int32_t at[kLanes];
  store(index, at);
  const auto* numbers = reinterpret_cast<const std::int32_t*>(base);
  for (std::size_t i = 0; i < kParts; ++i) {
    // In each block the pairs of two of its four lanes: the first and the third, or the second and the last.
    const auto pairsFrom = [&](std::size_t lane) HWY_ATTR {
      const auto read = [&](std::size_t block) HWY_ATTR {
        const std::int32_t* own = at + i * kPerPart + 4 * block + lane;
        return hn::Combine(quad, hn::LoadU(pair, numbers + own[2]), hn::LoadU(pair, numbers + own[0]));
      };
      return eachBlock(kInts, read);
    };
    const auto even = pairsFrom(0), odd = pairsFrom(1);
    first.part[i] = hn::OddEven(hn::Shuffle2301(odd), even);
    second.part[i] = hn::OddEven(odd, hn::Shuffle2301(even));
  }
}
/// Four numbers for each lane: `four[k]` holds the one that lies `k` behind base[index]. Of numbers that lie together
/// they are read far sooner than each by a gather of its own.
HWY_INLINE void gatherFours(const float* base, const Int& index, Float (&four)[4]) {
  constexpr hn::Full128<float> quad;
  constexpr hn::RepartitionToWide<FloatTag> pairs;
  alignas(64) std::int32_t at[kLanes];
  store(index, at);
  for (std::size_t i = 0; i < kParts; ++i) {
    // Row j: the numbers of lane j, of lane 4 + j and so on, a block each.
    hn::Vec<FloatTag> rows[4];
    for (std::size_t j = 0; j < 4; ++j) {
      const std::int32_t* lane = at + i * kPerPart + j;
      rows[j] = eachBlock(kFloats, [&](std::size_t block) HWY_ATTR { return hn::LoadU(quad, base + lane[4 * block]); });
    }
    const auto lower = [&](const auto& a, const auto& b)
                           HWY_ATTR { return hn::BitCast(pairs, hn::InterleaveLower(kFloats, a, b)); };
    const auto upper = [&](const auto& a, const auto& b)
                           HWY_ATTR { return hn::BitCast(pairs, hn::InterleaveUpper(kFloats, a, b)); };
    const auto first = lower(rows[0], rows[1]), second = lower(rows[2], rows[3]);
    const auto third = upper(rows[0], rows[1]), last = upper(rows[2], rows[3]);
    four[0].part[i] = hn::BitCast(kFloats, hn::InterleaveLower(pairs, first, second));
    four[1].part[i] = hn::BitCast(kFloats, hn::InterleaveUpper(pairs, first, second));
    four[2].part[i] = hn::BitCast(kFloats, hn::InterleaveLower(pairs, third, last));
    four[3].part[i] = hn::BitCast(kFloats, hn::InterleaveUpper(pairs, third, last));
  }
}
/// The reverse, for lanes that follow each other: four numbers of the first lane, four of the second and so on.
HWY_INLINE void storeFours(const Float (&four)[4], float* to) {
  for (std::size_t i = 0; i < kParts; ++i) {
    hn::StoreInterleaved4(four[0].part[i], four[1].part[i], four[2].part[i], four[3].part[i], kFloats,
                          to + 4 * i * kPerPart);
  }
}
/// Of 48 values the first, the second and the third of each three.
HWY_INLINE void loadTriples(const std::uint32_t* from, Int& a, Int& b, Int& c) {
  const auto* ints = reinterpret_cast<const std::int32_t*>(from);
  for (std::size_t i = 0; i < kParts; ++i) {
    hn::LoadInterleaved3(kInts, ints + 3 * i * kPerPart, a.part[i], b.part[i], c.part[i]);
  }
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
