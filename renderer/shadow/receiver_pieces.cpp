#include "renderer/shadow/receiver_pieces.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "renderer/shadow/depth_range.h"

namespace gnomon {
namespace {

/// Least and greatest of something, by component of light space.
struct Bounds {
  glm::dvec3 low{0};
  glm::dvec3 high{0};
};

/// What each of `count` columns or rows of blocks adds to a point of light space at depth 1 (perspective) or at any
/// depth (orthographic). `pixels` is the length of the picture along them, `axis` the step in light space for ndc 1.
std::vector<Bounds> strips(int count, int blockSize, int pixels, const glm::dvec3& axis) {
  constexpr double kMargin = 0.5; // pixels
  const auto at = [&](double pixel) { return axis * (2.0 * pixel / pixels - 1.0); };
  std::vector<Bounds> result;
  for (int i = 0; i < count; ++i) {
    const glm::dvec3 first = at(i * blockSize - kMargin);
    const glm::dvec3 last = at(std::min((i + 1) * blockSize, pixels) + kMargin);
    result.push_back({glm::min(first, last), glm::max(first, last)});
  }
  return result;
}

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
  const auto columns = strips(receivers.columns, receivers.blockSize, receivers.width, right);
  const auto rows = strips(receivers.rows, receivers.blockSize, receivers.height, down);
  const double nearest = cascade.near - depthSlack(view, cascade.near);
  const double farthest = cascade.far + depthSlack(view, cascade.far);

  std::size_t block = 0;
  for (const Bounds& row : rows) {
    for (const Bounds& column : columns) {
      const DepthSpan& span = receivers.blocks[block++];
      if (span.empty()) continue;
      const double near = std::max(nearest, span.nearest - depthSlack(view, span.nearest));
      const double far = std::min(farthest, span.farthest + depthSlack(view, span.farthest));
      if (!(near <= far)) continue;
      const glm::dvec3 low = column.low + row.low;
      const glm::dvec3 high = column.high + row.high;
      const int steps = stepsBetween(view, near, far);
      for (int step = 0; step < steps; ++step) {
        const double from = step == 0 ? near : near * std::pow(far / near, static_cast<double>(step) / steps);
        const double to = step + 1 == steps ? far : near * std::pow(far / near, (step + 1.0) / steps);
        // A coordinate of light space is linear in the depth, so its extremes are at the ends.
        Aabb piece;
        if (view.perspective) {
          piece.min = glm::min((forward + low) * from, (forward + low) * to);
          piece.max = glm::max((forward + high) * from, (forward + high) * to);
        } else {
          piece.min = low + glm::min(forward * from, forward * to);
          piece.max = high + glm::max(forward * from, forward * to);
        }
        pieces.push_back(piece);
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
