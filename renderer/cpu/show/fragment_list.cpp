#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE \
  "renderer/cpu/show/fragment_list.cpp" // NOLINT: Highway's foreach_target.h includes this file again
#include <algorithm>
#include <array>
#include <hwy/foreach_target.h>
#include <numeric>

#include "renderer/cpu/lanes/packing-inl.h"
#include "renderer/cpu/show/show_view.h"
#include "renderer/prepare/draw_list.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

/// Adds the lanes `where`, which show these triangles in these samples of the block's pixels.
HWY_INLINE void add(const Mask& where, const Int& triangle, int firstPixel, const Int& samples, FragmentList& list) {
  const Packing packing(where);
  packing.store(triangle, list.triangle.data() + list.count);
  packing.store(laneNumbers() + Int(firstPixel), list.pixel.data() + list.count);
  packing.store(samples, list.samples.data() + list.count);
  list.count += packing.count();
}

/// `numbers`: of a block's samples, sixteen each. `inside`: pixels of the picture.
template <int samples>
HWY_INLINE void listBlock(const std::uint32_t* numbers, const Mask& inside, int firstPixel, FragmentList& list) {
  const Int nothing(static_cast<std::int32_t>(kNoNumber));
  Int triangle[samples];
  Int differs(0);
  for (int s = 0; s < samples; ++s) {
    triangle[s] = load(numbers + s * kBlockPlaces);
    differs = differs | (triangle[s] ^ triangle[0]);
  }
  if (none(inside & (differs != Int(0)))) {
    const Mask shown = inside & (triangle[0] != nothing);
    if (any(shown)) add(shown, triangle[0], firstPixel, Int((1 << samples) - 1), list);
    return;
  }
  Int listed(0); // the samples whose triangles are listed
  for (int s = 0; s < samples; ++s) {
    Int same(1 << s);
    for (int other = s + 1; other < samples; ++other) {
      same = same | select(triangle[other] == triangle[s], Int(1 << other), Int(0));
    }
    const Mask shown = inside & (triangle[s] != nothing) & ((listed & Int(1 << s)) == Int(0));
    listed = listed | same;
    if (any(shown)) add(shown, triangle[s], firstPixel, same, list);
  }
}

template <int samples>
HWY_INLINE void listBlocks(const DepthBuffer& buffer, int x, int y, unsigned without, FragmentList& list) {
  const Int laneX = laneNumbers() & Int(kBlockSide - 1), laneY = shiftRight<2>(laneNumbers());
  for (int block = 0; block < static_cast<int>(kTilePixels) / kBlockPlaces; ++block) {
    const int column = x + columnOf(block * kBlockPlaces);
    const int row = y + rowOf(block * kBlockPlaces);
    if (column >= buffer.width || row >= buffer.height || (without >> block & 1u) != 0) continue;
    const Mask inside = (laneX < Int(buffer.width - column)) & (laneY < Int(buffer.height - row));
    listBlock<samples>(buffer.triangles.data() + buffer.at(column, row), inside, block * kBlockPlaces, list);
  }
}

void listFragmentsOn(const DepthBuffer& buffer, int x, int y, unsigned without, FragmentList& list) {
  list.count = 0;
  buffer.samples == 1 ? listBlocks<1>(buffer, x, y, without, list) : listBlocks<4>(buffer, x, y, without, list);
}

/// REQUIRES: the list is padded.
bool showsOneSlotOn(const FragmentList& list) {
  static_assert(kClusterTriangles == 1 << 10);
  const Int first(static_cast<std::int32_t>(list.triangle[0]));
  Int differs(0);
  for (std::size_t i = 0; i < list.count; i += kLanes) differs = differs | (load(&list.triangle[i]) ^ first);
  return all(shiftRightUnsigned<10>(differs) == Int(0));
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gnomon::cpu {

GNOMON_EXPORT_KERNEL(listFragmentsOn);

namespace {

GNOMON_EXPORT_KERNEL(showsOneSlotOn);

/// Fills the last packet with the last fragment.
void pad(FragmentList& list) {
  for (std::size_t i = list.count; list.count > 0 && i % FragmentList::kPacket != 0; ++i) {
    list.triangle[i] = list.triangle[list.count - 1];
    list.pixel[i] = list.pixel[list.count - 1];
    list.samples[i] = list.samples[list.count - 1];
  }
}

/// Moves the fragments of each slot together, slots in their order, so that those of an instance follow each other:
/// what works on a packet goes through it once for each of its instances. Of more slots than that all stay where they
/// are.
void gatherSlots(FragmentList& list) {
  static_assert(kClusterTriangles == 1 << 10);
  constexpr std::size_t kMost = 64;
  struct Found {
    std::uint32_t slot;
    std::size_t count, next;
  };
  std::array<Found, kMost> found;
  std::array<std::uint8_t, FragmentList::kMost> of; // which of these each fragment shows
  std::size_t slots = 0, last = 0;
  for (std::size_t i = 0; i < list.count; ++i) {
    const std::uint32_t slot = list.triangle[i] >> 10;
    if (slots == 0 || found[last].slot != slot) {
      for (last = 0; last < slots && found[last].slot != slot;) ++last;
      if (last == kMost) return;
      if (last == slots) found[slots++] = {slot, 0, 0};
    }
    ++found[last].count;
    of[i] = static_cast<std::uint8_t>(last);
  }
  std::array<std::uint8_t, kMost> order;
  std::iota(order.begin(), order.begin() + slots, std::uint8_t{0});
  std::sort(order.begin(), order.begin() + slots,
            [&](std::uint8_t a, std::uint8_t b) { return found[a].slot < found[b].slot; });
  std::size_t next = 0;
  for (std::size_t i = 0; i < slots; ++i) {
    found[order[i]].next = next;
    next += found[order[i]].count;
  }
  FragmentList gathered;
  for (std::size_t i = 0; i < list.count; ++i) {
    const std::size_t to = found[of[i]].next++;
    gathered.triangle[to] = list.triangle[i];
    gathered.pixel[to] = list.pixel[i];
    gathered.samples[to] = list.samples[i];
  }
  std::copy_n(gathered.triangle.begin(), list.count, list.triangle.begin());
  std::copy_n(gathered.pixel.begin(), list.count, list.pixel.begin());
  std::copy_n(gathered.samples.begin(), list.count, list.samples.begin());
}

} // namespace

void listFragments(const DepthBuffer& buffer, int x, int y, FragmentList& list, unsigned without) {
  GNOMON_KERNEL(listFragmentsOn)(buffer, x, y, without, list);
  pad(list);
  if (list.count == 0 || GNOMON_KERNEL(showsOneSlotOn)(list)) return;
  gatherSlots(list);
  pad(list);
}

} // namespace gnomon::cpu
#endif
