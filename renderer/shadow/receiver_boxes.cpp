#include "renderer/shadow/receiver_boxes.h"

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

/// What a column or a row of blocks adds to a point of light space at depth 1 (perspective) or at any depth
/// (orthographic).
struct Strips {
  std::vector<Bounds> columns;
  std::vector<Bounds> rows;
};

/// `count` strips along an axis of the picture that is `pixels` long; `axis` is the step in light space for ndc 1.
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

std::vector<Aabb> receiverBoxes(const CameraView& view, const ReceiverDepths& receivers, const LightBasis& basis,
                                const std::vector<CascadeInterval>& cascades) {
  std::vector<Aabb> boxes(cascades.size());
  if (receivers.range.empty()) return boxes;

  const glm::dmat3 lightFromWorld = basis.lightFromWorld();
  const glm::dvec3 forward = lightFromWorld * view.forward;
  const glm::dvec3 right = lightFromWorld * view.right * view.halfSize.x;
  const glm::dvec3 down = lightFromWorld * view.up * -view.halfSize.y; // rows count from the top of the picture
  const auto columns = strips(receivers.columns, receivers.blockSize, receivers.width, right);
  const auto rows = strips(receivers.rows, receivers.blockSize, receivers.height, down);

  std::vector<DepthInterval> served;
  for (const CascadeInterval& cascade : cascades) {
    served.push_back({cascade.near - depthSlack(view, cascade.near), cascade.far + depthSlack(view, cascade.far)});
  }

  std::size_t block = 0;
  for (const Bounds& row : rows) {
    for (const Bounds& column : columns) {
      const DepthSpan& span = receivers.blocks[block++];
      if (span.empty()) continue;
      const double nearest = span.nearest - depthSlack(view, span.nearest);
      const double farthest = span.farthest + depthSlack(view, span.farthest);
      const glm::dvec3 low = column.low + row.low;
      const glm::dvec3 high = column.high + row.high;
      for (std::size_t i = 0; i < served.size(); ++i) {
        const double near = std::max(nearest, served[i].near);
        const double far = std::min(farthest, served[i].far);
        if (!(near <= far)) continue;
        // A coordinate of light space is linear in the depth, so its extremes are at the ends.
        if (view.perspective) {
          const glm::dvec3 lowRay = forward + low;
          const glm::dvec3 highRay = forward + high;
          boxes[i].min = glm::min(boxes[i].min, glm::min(lowRay * near, lowRay * far));
          boxes[i].max = glm::max(boxes[i].max, glm::max(highRay * near, highRay * far));
        } else {
          boxes[i].min = glm::min(boxes[i].min, low + glm::min(forward * near, forward * far));
          boxes[i].max = glm::max(boxes[i].max, high + glm::max(forward * near, forward * far));
        }
      }
    }
  }
  return boxes;
}

} // namespace gnomon
