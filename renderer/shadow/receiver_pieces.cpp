#include "renderer/shadow/receiver_pieces.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "renderer/core/block_strips.h"
#include "renderer/shadow/depth_range.h"

namespace gnomon {
namespace {

/// Into how many steps to cut a piece from `near` to `far`, so that its sides spread by no more than a few percent.
int stepsBetween(const CameraView& view, double near, double far) {
  constexpr double kSpread = 1.1;
  constexpr int kMostSteps = 16;
  if (!view.perspective || !(near > 0)) return 1;
  return std::clamp(static_cast<int>(std::ceil(std::log(far / near) / std::log(kSpread))), 1, kMostSteps);
}

} // namespace

std::vector<Aabb> receiverPieces(const CameraView& view, const ReceiverDepths& receivers, const LightBasis& basis,
                                 const CascadeInterval& cascade) {
  std::vector<Aabb> pieces;
  const glm::dmat3 lightFromWorld = basis.lightFromWorld();
  const glm::dvec3 forward = lightFromWorld * view.forward;
  const glm::dvec3 right = lightFromWorld * view.right * view.halfSize.x;
  const glm::dvec3 down = lightFromWorld * view.up * -view.halfSize.y; // rows count from the top of the picture
  const auto columns = blockStrips(receivers.columns, receivers.blockSize, receivers.width, right);
  const auto rows = blockStrips(receivers.rows, receivers.blockSize, receivers.height, down);
  const double nearest = cascade.near - depthSlack(view, cascade.near);
  const double farthest = cascade.far + depthSlack(view, cascade.far);

  std::size_t block = 0;
  for (const BlockStrip& row : rows) {
    for (const BlockStrip& column : columns) {
      const DepthSpan& span = receivers.blocks[block++];
      if (span.empty()) continue;
      const double near = std::max(nearest, span.nearest - depthSlack(view, span.nearest));
      const double far = std::min(farthest, span.farthest + depthSlack(view, span.farthest));
      if (!(near <= far)) continue;
      const int steps = stepsBetween(view, near, far);
      for (int step = 0; step < steps; ++step) {
        const double from = step == 0 ? near : near * std::pow(far / near, static_cast<double>(step) / steps);
        const double to = step + 1 == steps ? far : near * std::pow(far / near, (step + 1.0) / steps);
        pieces.push_back(blockPiece(view.perspective, forward, column, row, from, to));
      }
    }
  }
  return pieces;
}

Aabb boxAround(const std::vector<Aabb>& boxes) {
  Aabb box;
  for (const Aabb& each : boxes) box.add(each);
  return box;
}

} // namespace gnomon
