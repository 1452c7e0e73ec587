#include "renderer/shadow/receiver_pieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/gtc/constants.hpp>
#include <limits>
#include <vector>

#include "renderer/core/camera_view.h"
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

constexpr int kDirections = 32; ///< over half a turn; each has two extreme points
constexpr int kSampledBlocks = 4096;

/// Corners of the points' hull, in order round it.
std::vector<glm::dvec2> hullCorners(std::span<const glm::dvec2> points) {
  std::array<glm::dvec2, kDirections> lowest{};
  std::array<glm::dvec2, kDirections> highest{};
  for (int k = 0; k < kDirections; ++k) {
    const double angle = glm::pi<double>() * k / kDirections;
    const glm::dvec2 direction(std::cos(angle), std::sin(angle));
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const glm::dvec2& point : points) {
      const double along = glm::dot(direction, point);
      if (along < low) {
        low = along;
        lowest[k] = point;
      }
      if (along > high) {
        high = along;
        highest[k] = point;
      }
    }
  }
  std::vector<glm::dvec2> corners(highest.begin(), highest.end());
  corners.insert(corners.end(), lowest.begin(), lowest.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  return corners;
}

double areaAt(double angle, const std::vector<glm::dvec2>& points) {
  const glm::dvec2 right(std::cos(angle), std::sin(angle));
  const glm::dvec2 up(-right.y, right.x);
  glm::dvec2 low(std::numeric_limits<double>::infinity());
  glm::dvec2 high = -low;
  for (const glm::dvec2& point : points) {
    const glm::dvec2 at(glm::dot(right, point), glm::dot(up, point));
    low = glm::min(low, at);
    high = glm::max(high, at);
  }
  return (high.x - low.x) * (high.y - low.y);
}

struct Roll {
  double angle = 0; ///< radians
  double area = 0;
};

/// Rolls whose areas differ by no more than this factor are as good as each other.
constexpr double kAlike = 1.0001;

/// Of two opposite turns one is preferred. The half circle ends at 67.5 degrees, for sides often lie along axes.
bool isPreferred(double angle) {
  constexpr double kEnd = 0.375 * glm::pi<double>();
  return angle > kEnd - glm::pi<double>() && angle <= kEnd;
}

} // namespace

std::vector<glm::dvec3> sampledReceivers(const CameraView& view, const ReceiverDepths& receivers,
                                         const DepthInterval& depths) {
  std::vector<glm::dvec3> points;
  const int stride =
      static_cast<int>(std::ceil(std::sqrt(static_cast<double>(receivers.columns) * receivers.rows / kSampledBlocks)));
  for (int row = 0; row < receivers.rows; row += stride) {
    for (int column = 0; column < receivers.columns; column += stride) {
      const DepthSpan& span = receivers.blocks[static_cast<std::size_t>(row * receivers.columns + column)];
      if (span.empty()) continue;
      const double near = std::max<double>(span.nearest, depths.near);
      const double far = std::min<double>(span.farthest, depths.far);
      if (!(near <= far)) continue;
      const glm::dvec2 ndc((2.0 * column + 1.0) / receivers.columns - 1.0, 1.0 - (2.0 * row + 1.0) / receivers.rows);
      for (const double depth : {near, far}) points.push_back(pointAt(view, ndc, depth));
    }
  }
  return points;
}

std::vector<Aabb> receiverPieces(const CameraView& view, const ReceiverDepths& receivers, const LightBasis& basis,
                                 const CascadeInterval& cascade) {
  std::vector<Aabb> pieces;
  const glm::dmat3 lightFromWorld = basis.lightFromWorld();
  const glm::dvec3 middle = lightFromWorld * wayToMiddle(view);
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
        pieces.push_back(blockPiece(view.perspective, middle, column, row, from, to));
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

LightBasis rolled(const LightBasis& basis, double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {basis.right * c + basis.up * s, basis.up * c - basis.right * s, basis.direction};
}

// Parallel sides of the hull give rectangles that differ by half a turn, and a right angle ones that differ by a
// quarter, all as large but for rounding; devices round depths differently and must choose the same.
double rollOfLeastArea(std::span<const glm::dvec2> points, double leastSaved) {
  if (points.empty()) return 0.0;
  const std::vector<glm::dvec2> corners = hullCorners(points);
  std::vector<Roll> rolls{{0.0, areaAt(0.0, corners)}};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec2 side = corners[(i + 1) % corners.size()] - corners[i];
    if (side == glm::dvec2(0.0)) continue;
    const double angle = std::atan2(side.y, side.x);
    rolls.push_back({angle, areaAt(angle, corners)});
  }
  const double least =
      std::min_element(rolls.begin(), rolls.end(), [](const Roll& a, const Roll& b) { return a.area < b.area; })->area;
  if (least > (1.0 - leastSaved) * rolls.front().area) return 0.0;
  const double most = kAlike * least;
  const auto end =
      std::stable_partition(rolls.begin(), rolls.end(), [=](const Roll& roll) { return roll.area <= most; });
  const auto preferred = std::find_if(rolls.begin(), end, [](const Roll& roll) { return isPreferred(roll.angle); });
  return (preferred != end ? *preferred : rolls.front()).angle;
}

LightBasis tightBasis(const CameraView& view, const ReceiverDepths& receivers, const LightBasis& basis,
                      const CascadeInterval& cascade) {
  std::vector<glm::dvec2> onMap;
  for (const glm::dvec3& point : sampledReceivers(view, receivers, {cascade.near, cascade.far})) {
    onMap.emplace_back(glm::dot(basis.right, point), glm::dot(basis.up, point));
  }
  return rolled(basis, rollOfLeastArea(onMap));
}

} // namespace gnomon
