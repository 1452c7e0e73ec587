// Which fragments the pixels of a square show, held against a look at each sample.
#include <algorithm>
#include <map>
#include <rapidcheck/gtest.h>
#include <set>

#include "renderer/cpu/show/show_view.h"
#include "renderer/prepare/draw_list.h"

namespace gnomon::cpu {
namespace {

/// A picture of a few triangles of some slots, with gaps. What lies beyond its edges means nothing.
DepthBuffer buffer(int width, int height, int samples, std::uint32_t slots) {
  DepthBuffer buffer{.width = width, .height = height, .samples = samples};
  buffer.triangles.resize(buffer.places());
  for (std::uint32_t& triangle : buffer.triangles) {
    const auto slot = *rc::gen::inRange<std::uint32_t>(0, slots + 1);
    triangle = slot == slots ? kNoNumber : slot * kClusterTriangles + *rc::gen::inRange<std::uint32_t>(0, 3);
  }
  return buffer;
}

/// Pixel of the square, triangle, and the samples that show it.
using Fragment = std::tuple<int, std::uint32_t, int>;

std::set<Fragment> fragmentsOf(const DepthBuffer& buffer, int x, int y) {
  std::map<std::pair<int, std::uint32_t>, int> samples;
  for (int pixel = 0; pixel < static_cast<int>(kTilePixels); ++pixel) {
    const int column = x + columnOf(pixel), row = y + rowOf(pixel);
    if (column >= buffer.width || row >= buffer.height) continue;
    for (int s = 0; s < buffer.samples; ++s) {
      const std::uint32_t triangle = buffer.triangles[buffer.at(column, row, s)];
      if (triangle != kNoNumber) samples[{pixel, triangle}] |= 1 << s;
    }
  }
  std::set<Fragment> fragments;
  for (const auto& [shown, bits] : samples) fragments.insert({shown.first, shown.second, bits});
  return fragments;
}

RC_GTEST_PROP(FragmentList, HoldsWhatEachSampleShowsAndThoseOfASlotTogether, ()) {
  const int samples = *rc::gen::element(1, 4);
  const auto slots = *rc::gen::element<std::uint32_t>(1, 2, 7, 90);
  const DepthBuffer picture = buffer(*rc::gen::inRange(1, 33), *rc::gen::inRange(1, 33), samples, slots);
  const int x = picture.width > kTileSide ? kTileSide : 0, y = picture.height > kTileSide ? kTileSide : 0;
  FragmentList list;
  listFragments(picture, x, y, list);

  std::set<Fragment> listed;
  std::size_t changes = 0;
  std::set<std::uint32_t> shown;
  for (std::size_t i = 0; i < list.count; ++i) {
    const std::uint32_t slot = list.triangle[i] / kClusterTriangles;
    changes += i > 0 && slot != list.triangle[i - 1] / kClusterTriangles ? 1 : 0;
    shown.insert(slot);
    listed.insert({list.pixel[i], list.triangle[i], list.samples[i]});
  }
  RC_ASSERT(listed.size() == list.count);
  RC_ASSERT(listed == fragmentsOf(picture, x, y));
  if (!shown.empty() && slots <= 7) RC_ASSERT(changes == shown.size() - 1);
  for (std::size_t i = list.count; list.count > 0 && i % FragmentList::kPacket != 0; ++i) {
    RC_ASSERT(list.triangle[i] == list.triangle[list.count - 1]);
  }
}

} // namespace
} // namespace gnomon::cpu
