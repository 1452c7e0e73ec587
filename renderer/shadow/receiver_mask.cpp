#include "renderer/shadow/receiver_mask.h"

#include <algorithm>
#include <cstddef>

#include "renderer/shadow/shadow_plan.h"

namespace gnomon {
namespace {

// Far above the rounding of doubles, far below a texel.
constexpr double kRounding = 1e-7;

/// First and last cell of a stretch of clip space, cut to the tile; none where first > last.
struct Cells {
  int first = 0;
  int last = -1;
};

Cells cellsOf(double low, double high) {
  if (high < -1.0 || low > 1.0) return {};
  const auto cell = [](double clip) {
    return std::clamp(static_cast<int>((std::clamp(clip, -1.0, 1.0) * 0.5 + 0.5) * ReceiverMask::kSide), 0,
                      ReceiverMask::kSide - 1);
  };
  return {cell(low), cell(high)};
}

} // namespace

bool ReceiverMask::mayShadow(const Aabb& box) const {
  const Cells columns = cellsOf(box.min.x - kRounding, box.max.x + kRounding);
  const Cells rows = cellsOf(box.min.y - kRounding, box.max.y + kRounding);
  for (int row = rows.first; row <= rows.last; ++row) {
    const float* cells = farthest.data() + static_cast<std::size_t>(row) * kSide;
    for (int column = columns.first; column <= columns.last; ++column) {
      if (cells[column] >= 0.0f && box.min.z <= cells[column] + kRounding) return true;
    }
  }
  return false;
}

ReceiverMask receiverMask(const std::vector<Aabb>& piecesClip, const glm::dvec2& margin) {
  ReceiverMask mask;
  mask.farthest.assign(static_cast<std::size_t>(ReceiverMask::kSide) * ReceiverMask::kSide, -1.0f);
  for (const Aabb& piece : piecesClip) {
    const Cells columns = cellsOf(piece.min.x - margin.x, piece.max.x + margin.x);
    const Cells rows = cellsOf(piece.min.y - margin.y, piece.max.y + margin.y);
    const auto z = static_cast<float>(std::clamp(piece.max.z, 0.0, 1.0));
    for (int row = rows.first; row <= rows.last; ++row) {
      float* cells = mask.farthest.data() + static_cast<std::size_t>(row) * ReceiverMask::kSide;
      for (int column = columns.first; column <= columns.last; ++column) cells[column] = std::max(cells[column], z);
    }
  }
  return mask;
}

// Along each clip axis the box reaches as far as its half extents do through the absolute matrix (Arvo, Graphics Gems
// 1990). Towards the light nothing limits a caster: whatever stands before z 0 is drawn with its depth clamped.
bool mayCastInto(const ShadowTile& tile, const Aabb& casterBounds) {
  if (tile.rect.width <= 0 || casterBounds.empty()) return false;
  const Aabb clip = clipBox(tile.space, lightSpaceBox(tile.space, casterBounds));
  return !clip.empty() && tile.receivers.mayShadow(clip);
}

} // namespace gnomon
