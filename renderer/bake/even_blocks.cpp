#include "renderer/bake/even_blocks.h"

#include <algorithm>

#include "renderer/core/parallel.h"

namespace gnomon {
namespace {

std::uint16_t shareOfBlock(const LightMap& map, int x, int y) {
  const int width = std::min(EvenBlocks::kSide + 1, map.width - x);
  const int top = std::min(y + EvenBlocks::kSide, map.height - 1);
  const std::uint16_t share = map.at(x, y);
  for (int row = y; row <= top; ++row) {
    const auto first = map.shares.begin() + (std::ptrdiff_t{row} * map.width + x);
    if (!std::all_of(first, first + width, [&](std::uint16_t other) { return other == share; }))
      return EvenBlocks::kUneven;
  }
  return share;
}

} // namespace

EvenBlocks evenBlocks(const LightMap& map) {
  constexpr int kSide = EvenBlocks::kSide;
  EvenBlocks even{(map.width + kSide - 1) / kSide, {}};
  const int rows = (map.height + kSide - 1) / kSide;
  even.shares.resize(static_cast<std::size_t>(even.columns) * static_cast<std::size_t>(rows) + 1);
  forEach(static_cast<std::size_t>(rows), [&](std::size_t row) {
    const int y = static_cast<int>(row) * kSide;
    std::uint16_t* const out = even.shares.data() + row * static_cast<std::size_t>(even.columns);
    for (int column = 0; column < even.columns; ++column) out[column] = shareOfBlock(map, column * kSide, y);
  });
  return even;
}

} // namespace gnomon
