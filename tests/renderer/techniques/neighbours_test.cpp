#include "renderer/techniques/neighbours.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

namespace gnomon {
namespace {

/// The same, said plainly.
std::vector<std::uint32_t> differing(const SampleGrid& grid, const std::vector<std::uint8_t>& values) {
  std::vector<std::uint32_t> pixels;
  const auto at = [&](int x, int y) { return values[static_cast<std::size_t>(y * grid.width + x)]; };
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      bool differs = false;
      for (int v = std::max(y - 1, 0); v <= std::min(y + 1, grid.height - 1); ++v) {
        for (int u = std::max(x - 1, 0); u <= std::min(x + 1, grid.width - 1); ++u) {
          for (int t = std::max(y - 1, 0); t <= std::min(y + 1, grid.height - 1); ++t) {
            for (int s = std::max(x - 1, 0); s <= std::min(x + 1, grid.width - 1); ++s) {
              differs = differs || at(u, v) != at(s, t);
            }
          }
        }
      }
      if (differs) pixels.push_back(static_cast<std::uint32_t>(y * grid.width + x));
    }
  }
  return pixels;
}

TEST(Neighbours, AreThoseAroundAPixelInsideThePicture) {
  EXPECT_TRUE(rc::check([] {
    constexpr int kRows = int(kScanRows);
    SampleGrid grid;
    grid.width = *rc::gen::inRange(1, 30);
    // Low ones, and those that several cores look through.
    grid.height = *rc::gen::oneOf(rc::gen::inRange(1, 9), rc::gen::inRange(kRows - 2, 2 * kRows + 2));
    const auto values = *rc::gen::container<std::vector<std::uint8_t>>(
        grid.pixels(), rc::gen::weightedElement<std::uint8_t>({{6, 0}, {1, 1}, {1, 255}}));
    const auto found = pixelsWhere(grid, values, [](std::uint8_t least, std::uint8_t most) { return least != most; });
    RC_ASSERT(found == differing(grid, values));
  }));
}

} // namespace
} // namespace gnomon
