#include "renderer/bake/light_map.h"

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

/// Texels that are read from, each with the three beside it to the right and above.
struct TexelRange {
  glm::ivec2 first, last;
};

/// What a triangle reads from; a little more, as places within it are rounded.
TexelRange texelsOf(const LightMap& map, const glm::vec2* corners) {
  constexpr float kRoom = 1.0f / 64;
  const glm::vec2 low = glm::min(glm::min(corners[0], corners[1]), corners[2]) - (0.5f + kRoom);
  const glm::vec2 high = glm::max(glm::max(corners[0], corners[1]), corners[2]) - (0.5f - kRoom);
  const glm::ivec2 most = glm::max(glm::ivec2(map.width, map.height) - 2, 0);
  return {glm::clamp(glm::ivec2(glm::floor(low)), glm::ivec2(0), most),
          glm::clamp(glm::ivec2(glm::floor(high)), glm::ivec2(0), most)};
}

bool allAre(const LightMap& map, std::uint16_t share, const TexelRange& range) {
  for (int y = range.first.y; y <= range.last.y + 1; ++y) {
    for (int x = range.first.x; x <= range.last.x + 1; ++x) {
      if (map.at(x, y) != share) return false;
    }
  }
  return true;
}

std::uint16_t shareOfTriangle(const LightMap& map, const EvenBlocks& even, const glm::vec2* corners) {
  constexpr int kSide = EvenBlocks::kSide;
  const TexelRange range = texelsOf(map, corners);
  const std::uint16_t share = map.at(range.first.x, range.first.y);
  for (int row = range.first.y / kSide; row <= range.last.y / kSide; ++row) {
    for (int column = range.first.x / kSide; column <= range.last.x / kSide; ++column) {
      const std::uint16_t block = even.shares[static_cast<std::size_t>(row * even.columns + column)];
      if (block == share && share != EvenBlocks::kUneven) continue;
      const glm::ivec2 corner = glm::ivec2(column, row) * kSide;
      const TexelRange here{glm::max(range.first, corner), glm::min(range.last, corner + (kSide - 1))};
      if (block != EvenBlocks::kUneven || !allAre(map, share, here)) return EvenBlocks::kUneven;
    }
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

std::vector<std::uint16_t> evenTriangles(const LightMap& map, const EvenBlocks& even,
                                         std::span<const glm::vec2> corners) {
  const std::size_t count = corners.size() / 3;
  std::vector<std::uint16_t> shares(count + 1);
  forEachPiece(count, 4096, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) shares[i] = shareOfTriangle(map, even, &corners[3 * i]);
  });
  return shares;
}

} // namespace gnomon
