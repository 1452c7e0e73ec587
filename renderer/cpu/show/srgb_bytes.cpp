#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderer/cpu/show/srgb_bytes.cpp" // NOLINT: Highway's foreach_target.h includes this again
#include "renderer/cpu/show/srgb_bytes.h"

#include <algorithm>
#include <bit>
#include <hwy/foreach_target.h>

#include "renderer/core/srgb.h"
#include "renderer/cpu/lanes/functions-inl.h"
#include "renderer/cpu/lanes/gather-inl.h"

#ifndef GNOMON_CPU_SRGB_TABLE
#define GNOMON_CPU_SRGB_TABLE
namespace gnomon::cpu {

/// A number's byte by its leading bits: the byte where numbers with these begin, and from which of their other bits on
/// it is one more.
struct SrgbTable {
  static constexpr std::uint32_t kLeastBits = 0x39000000u; ///< 2^-13: up to there, a byte is 0
  static constexpr int kDropped = 16;                      ///< 128 steps an octave, so that none spans two bytes
  static constexpr int kByte = 17;                         ///< where an entry's byte begins; 2^16 below it is never met

  std::array<std::int32_t, ((0x3f800000u - kLeastBits) >> kDropped) + 1> entries{};

  SrgbTable() {
    std::array<float, 256> next{}; // where each byte ends
    for (int byte = 0; byte < 255; ++byte) {
      next[static_cast<std::size_t>(byte)] = static_cast<float>(linearOf((byte + 0.5) / 255.0));
    }
    next[255] = 2.0f;
    for (std::uint32_t i = 0; i < entries.size(); ++i) {
      const std::uint32_t least = kLeastBits + (i << kDropped);
      const auto byte = std::upper_bound(next.begin(), next.end(), std::bit_cast<float>(least)) - next.begin();
      const std::uint32_t left = std::bit_cast<std::uint32_t>(next[static_cast<std::size_t>(byte)]) - least;
      entries[i] = static_cast<std::int32_t>(byte << kByte | std::min(left, 1u << kDropped));
    }
  }
};

} // namespace gnomon::cpu
#endif

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

HWY_INLINE Int srgbByte(const SrgbTable& table, const Float& linear) {
  const Mask some = linear > Float(std::bit_cast<float>(SrgbTable::kLeastBits)); // not where it is no number
  const Int bits = bitsOf(min(linear, 1.0f)) - Int(static_cast<std::int32_t>(SrgbTable::kLeastBits));
  const Int entry = gather(table.entries.data(), select(some, shiftRight<SrgbTable::kDropped>(bits), Int(0)));
  const Int byte = shiftRight<SrgbTable::kByte>(entry);
  const Mask more = (bits & Int((1 << SrgbTable::kDropped) - 1)) >= (entry & Int((1 << SrgbTable::kByte) - 1));
  return select(some, select(more, byte + Int(1), byte), Int(0));
}

/// Of each four numbers of four bytes the lowest three bytes, side by side.
HWY_INLINE Int withoutFourthBytes(const Int& a) {
  constexpr hn::Repartition<std::uint8_t, IntTag> bytes;
  alignas(16) static constexpr std::uint8_t kFrom[16] = {0, 1, 2, 4, 5, 6, 8, 9, 10, 12, 13, 14, 3, 7, 11, 15};
  Int packed;
  for (std::size_t i = 0; i < kParts; ++i) {
    packed.part[i] =
        hn::BitCast(kInts, hn::TableLookupBytes(hn::BitCast(bytes, a.part[i]), hn::LoadDup128(bytes, kFrom)));
  }
  return packed;
}

void srgbBytesOn(const TileColors& colors, const SrgbTable& table, bool alpha, TileBytes& bytes) {
  for (std::size_t i = 0; i < kTilePixels; i += kLanes) {
    const Int r = srgbByte(table, load(&colors.channels[0][i]));
    const Int g = srgbByte(table, load(&colors.channels[1][i]));
    const Int b = srgbByte(table, load(&colors.channels[2][i]));
    const Int rgb = r | shiftLeft<8>(g) | shiftLeft<16>(b);
    auto* const to = reinterpret_cast<std::int32_t*>(&bytes.pixels[4 * i]);
    if (!alpha) {
      store(withoutFourthBytes(rgb), to);
      continue;
    }
    const Int a = truncated(clamp(load(&colors.channels[3][i]), 0.0f, 1.0f) * 255.0f + 0.5f);
    store(rgb | shiftLeft<24>(a), to);
  }
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gnomon::cpu {
namespace {
GNOMON_EXPORT_KERNEL(srgbBytesOn);
} // namespace

TileBytes srgbBytes(const TileColors& colors, std::size_t channels) {
  static const SrgbTable table;
  TileBytes bytes;
  GNOMON_KERNEL(srgbBytesOn)(colors, table, channels == 4, bytes);
  return bytes;
}

} // namespace gnomon::cpu
#endif
