#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE \
  "renderer/cpu/show/fragment_list.cpp" // NOLINT: Highway's foreach_target.h includes this file again
#include <hwy/foreach_target.h>

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
  if (list.count == 0) return;
  // Whole packets may be read.
  const std::size_t last = list.count - 1;
  for (std::size_t i = list.count; i % kLanes != 0; ++i) {
    list.triangle[i] = list.triangle[last];
    list.pixel[i] = list.pixel[last];
    list.samples[i] = list.samples[last];
  }
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gnomon::cpu {

GNOMON_EXPORT_KERNEL(listFragmentsOn);

void listFragments(const DepthBuffer& buffer, int x, int y, FragmentList& list, unsigned without) {
  GNOMON_KERNEL(listFragmentsOn)(buffer, x, y, without, list);
}

} // namespace gnomon::cpu
#endif
