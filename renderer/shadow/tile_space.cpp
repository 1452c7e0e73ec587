#include "renderer/shadow/tile_space.h"

#include <algorithm>
#include <cstddef>

#include "renderer/shadow/shadow_plan.h"

namespace gnomon {
namespace {

/// Least and greatest of x / z over a box's x and z, z > 0.
glm::dvec2 quotients(double low, double high, double near, double far) {
  return {low >= 0 ? low / far : low / near, high >= 0 ? high / near : high / far};
}

double depthFar(const Fit& fit) {
  return fit.depthNear + fit.depthExtent;
}

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

glm::dmat4 clipFromLight(const TileSpace& space) {
  const Fit& fit = space.fit;
  const glm::dvec2 size = fit.texelSize * static_cast<double>(space.size);
  glm::dmat4 clip(0.0);
  clip[0][0] = 2.0 / size.x;
  clip[1][1] = 2.0 / size.y;
  const glm::dvec2 corner = -2.0 * fit.lowest / size - 1.0;
  if (fit.perspective) {
    // z / w = far (depth - near) / (depth (far - near))
    clip[2] = glm::dvec4(corner, depthFar(fit) / fit.depthExtent, 1.0);
    clip[3][2] = -fit.depthNear * depthFar(fit) / fit.depthExtent;
  } else {
    clip[2][2] = 1.0 / fit.depthExtent;
    clip[3] = glm::dvec4(corner, -fit.depthNear / fit.depthExtent, 1.0);
  }
  return clip;
}

Aabb lightSpaceBox(const TileSpace& space, const Aabb& relative) {
  return transformed(lightFromRelative(space.basis, space.origin), relative);
}

Aabb clipBox(const TileSpace& space, const Aabb& boxLs) {
  const Fit& fit = space.fit;
  if (boxLs.empty()) return {};
  const glm::dvec2 size = fit.texelSize * static_cast<double>(space.size);
  const auto onTile = [&](const glm::dvec2& at) { return (at - fit.lowest) * (2.0 / size) - 1.0; };
  if (!fit.perspective) {
    const glm::dvec2 low = onTile(glm::dvec2(boxLs.min));
    const glm::dvec2 high = onTile(glm::dvec2(boxLs.max));
    return {glm::dvec3(low, (boxLs.min.z - fit.depthNear) / fit.depthExtent),
            glm::dvec3(high, (boxLs.max.z - fit.depthNear) / fit.depthExtent)};
  }
  if (boxLs.max.z <= 0) return {};
  // A part of the box behind the light casts no shadow; one beside it reaches out without a known limit.
  const double near = std::max(boxLs.min.z, 1e-9 * depthFar(fit));
  const double far = std::max(boxLs.max.z, near);
  const glm::dvec2 x = quotients(boxLs.min.x, boxLs.max.x, near, far);
  const glm::dvec2 y = quotients(boxLs.min.y, boxLs.max.y, near, far);
  const auto z = [&](double depth) { return depthFar(fit) * (1.0 - fit.depthNear / depth) / fit.depthExtent; };
  return {glm::dvec3(onTile({x[0], y[0]}), z(near)), glm::dvec3(onTile({x[1], y[1]}), z(far))};
}

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
// 1990). Towards the light nothing limits a caster: whatever is before z 0 is drawn with its depth clamped.
bool mayCastInto(const ShadowTile& tile, const Aabb& casterBounds) {
  if (tile.rect.width <= 0 || casterBounds.empty()) return false;
  const Aabb clip = clipBox(tile.space, lightSpaceBox(tile.space, casterBounds));
  return !clip.empty() && tile.receivers.mayShadow(clip);
}

} // namespace gnomon
