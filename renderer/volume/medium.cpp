#include "renderer/volume/medium.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>

#include "renderer/core/parallel.h"
#include "renderer/volume/extinction_cells.h"

namespace gnomon {

namespace {

std::size_t indexOf(const glm::ivec3& place, const glm::ivec3& size) {
  return (static_cast<std::size_t>(place.z) * size.y + place.y) * static_cast<std::size_t>(size.x) + place.x;
}

/// Whether any place of a brick takes light, read from one voxel more on each side.
bool isFilled(const DensityGrid& grid, const TransferFunction& function, const glm::ivec3& brick) {
  const glm::ivec3 low = glm::max(brick * kBrickSide - 1, glm::ivec3(0));
  const glm::ivec3 high = glm::min((brick + 1) * kBrickSide, grid.size - 1);
  float least = std::numeric_limits<float>::infinity(), largest = -least;
  for (int z = low.z; z <= high.z; ++z) {
    for (int y = low.y; y <= high.y; ++y) {
      for (int x = low.x; x <= high.x; ++x) {
        least = std::min(least, grid.at(x, y, z));
        largest = std::max(largest, grid.at(x, y, z));
      }
    }
  }
  return largestExtinction(function, double{least}, double{largest}) > 0;
}

/// Whether `number` is in the range; NaN is not.
bool within(double number, double low, double high) {
  return number >= low && number <= high;
}

void check(const TransferPoint& point, const std::string& place, ProblemList& problems) {
  if (!std::isfinite(point.value)) {
    problems.add({ProblemCode::invalidValue, place + "/value", "A value is a finite number.", "finite",
                  std::to_string(point.value)});
  }
  for (int i = 0; i < 3; ++i) {
    if (within(point.matter.color[i], 0, 1)) continue;
    problems.add({ProblemCode::invalidValue, place + "/color/" + std::to_string(i), "A color is out of its range.",
                  "0..1", std::to_string(point.matter.color[i])});
  }
  if (!within(point.matter.extinction, 0, kMaxExtinction)) {
    problems.add({ProblemCode::invalidValue, place + "/extinction", "An extinction is out of its range.",
                  "0..1000000 per metre", std::to_string(point.matter.extinction)});
  }
}

Bricks bricksOf(const DensityGrid& grid, const TransferFunction& function) {
  Bricks bricks{(grid.size + kBrickSide - 1) / kBrickSide, {}};
  const glm::ivec3 size = bricks.size;
  const std::size_t rows = static_cast<std::size_t>(size.y) * static_cast<std::size_t>(size.z);
  bricks.filled.resize(rows * static_cast<std::size_t>(size.x));
  forEach(rows, [&](std::size_t row) {
    const int y = static_cast<int>(row) % size.y, z = static_cast<int>(row) / size.y;
    for (int x = 0; x < size.x; ++x) {
      bricks.filled[indexOf({x, y, z}, size)] = isFilled(grid, function, {x, y, z}) ? 1 : 0;
    }
  });
  return bricks;
}

} // namespace

Medium makeMedium(std::shared_ptr<const DensityGrid> grid, TransferFunction function, const VolumeSpace& space) {
  Bricks bricks = bricksOf(*grid, function);
  auto cells = std::make_shared<const ExtinctionCells>(extinctionCells(*grid, function, bricks));
  return {.grid = std::move(grid),
          .function = std::move(function),
          .space = space,
          .bricks = std::move(bricks),
          .cells = std::move(cells)};
}

BrickPassage brickAt(const Medium& medium, const Ray& unitRay, double distance) {
  const glm::dvec3 perBrick = glm::dvec3(medium.grid->size) / double{kBrickSide};
  const glm::dvec3 place = pointAt(unitRay, distance) * perBrick;
  const glm::ivec3 brick = glm::ivec3(glm::clamp(place, glm::dvec3(0), glm::dvec3(medium.bricks.size - 1)));
  double until = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    const double speed = unitRay.direction[axis] * perBrick[axis];
    if (speed == 0) continue;
    until = std::min(until, distance + (brick[axis] + (speed > 0 ? 1 : 0) - place[axis]) / speed);
  }
  return {std::max(until, distance), medium.bricks.filled[indexOf(brick, medium.bricks.size)] != 0};
}

Result<TransferFunction> makeTransferFunction(std::vector<TransferPoint> points) {
  if (points.empty() || points.size() > kMaxTransferPoints) {
    return Problem{ProblemCode::invalidValue, "", "A transfer function has too few or too many points.",
                   "1.." + std::to_string(kMaxTransferPoints), std::to_string(points.size())};
  }
  ProblemList problems;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::string place = "/" + std::to_string(i);
    check(points[i], place, problems);
    if (i > 0 && points[i].value <= points[i - 1].value) {
      problems.add({ProblemCode::invalidValue, place + "/value", "The values of a transfer function increase.",
                    "> " + std::to_string(points[i - 1].value), std::to_string(points[i].value)});
    }
  }
  if (!problems.empty()) return std::move(problems).take();
  return TransferFunction{std::move(points)};
}

Matter matterOf(const TransferFunction& function, double value) {
  const auto& points = function.points;
  const auto next = std::upper_bound(points.begin(), points.end(), value,
                                     [](double v, const TransferPoint& point) { return v < point.value; });
  if (next == points.begin()) return points.front().matter;
  if (next == points.end()) return points.back().matter;
  const TransferPoint& last = *std::prev(next);
  // Halves, as the difference of two finite values may not be finite.
  const double share = (value / 2 - last.value / 2) / (next->value / 2 - last.value / 2);
  return {glm::mix(last.matter.color, next->matter.color, share),
          glm::mix(last.matter.extinction, next->matter.extinction, share)};
}

double largestExtinction(const TransferFunction& function, double low, double high) {
  double largest = std::max(matterOf(function, low).extinction, matterOf(function, high).extinction);
  for (const TransferPoint& point : function.points) {
    if (within(point.value, low, high)) largest = std::max(largest, point.matter.extinction);
  }
  return largest;
}

double largestExtinction(const TransferFunction& function) {
  double largest = 0;
  for (const TransferPoint& point : function.points) largest = std::max(largest, point.matter.extinction);
  return largest;
}

} // namespace gnomon
