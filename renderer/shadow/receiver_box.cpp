#include "renderer/shadow/receiver_box.h"

#include <algorithm>
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

} // namespace

Aabb receiverBox(const CameraView& view, const ReceiverDepths& receivers, const LightBasis& basis,
                 const CascadeInterval& cascade) {
  Aabb box;
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
      // A coordinate of light space is linear in the depth, so its extremes are at the ends.
      if (view.perspective) {
        box.min = glm::min(box.min, glm::min((forward + low) * near, (forward + low) * far));
        box.max = glm::max(box.max, glm::max((forward + high) * near, (forward + high) * far));
      } else {
        box.min = glm::min(box.min, low + glm::min(forward * near, forward * far));
        box.max = glm::max(box.max, high + glm::max(forward * near, forward * far));
      }
    }
  }
  return box;
}

} // namespace gnomon
