#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "protocol/base/result.h"
#include "protocol/spec/limits.h"
#include "renderer/volume/density_grid.h"
#include "renderer/volume/volume_space.h"

namespace gnomon {

inline constexpr std::size_t kMaxTransferPoints = kLimits.maxTransferStops;
inline constexpr double kMaxExtinction = 1e6; ///< per metre

/// What a medium does to light at one place.
struct Matter {
  glm::dvec3 color{0};   ///< the share of each component that is scattered of what is taken away, 0..1
  double extinction = 0; ///< what is taken away, per metre, >= 0

  bool operator==(const Matter&) const = default;
};

struct TransferPoint {
  double value = 0; ///< of the grid
  Matter matter;

  bool operator==(const TransferPoint&) const = default;
};

/// Piecewise linear between its points; the first and last go on beyond them. Values increase.
struct TransferFunction {
  std::vector<TransferPoint> points;

  bool operator==(const TransferFunction&) const = default;
};

/// A function of these points, or its problems at "/INDEX/value", "/INDEX/color/0" or "/INDEX/extinction".
Result<TransferFunction> makeTransferFunction(std::vector<TransferPoint> points);

Matter matterOf(const TransferFunction& function, double value);

/// The largest extinction of any value from `low` to `high`. REQUIRES: low <= high.
double largestExtinction(const TransferFunction& function, double low, double high);

/// The largest extinction of any value.
double largestExtinction(const TransferFunction& function);

inline constexpr int kBrickSide = 8; ///< voxels

/// Which bricks of a grid hold something, x fastest.
struct Bricks {
  glm::ivec3 size{0};
  std::vector<std::uint8_t> filled; ///< 0: no place in the brick takes any light
};

struct ExtinctionCells;

/// What dims light where it passes: a grid, placed, with a transfer function.
struct Medium {
  std::shared_ptr<const DensityGrid> grid;
  TransferFunction function;
  VolumeSpace space;
  bool visible = true;       ///< to the camera
  bool castShadow = true;    ///< on surfaces and media, itself among them
  bool receiveShadow = true; ///< from surfaces and media, itself among them
  Bricks bricks{};
  std::shared_ptr<const ExtinctionCells> cells{}; ///< its extinction, coarser
};

Medium makeMedium(std::shared_ptr<const DensityGrid> grid, TransferFunction function, const VolumeSpace& space);

/// At a place of the unit cube.
inline Matter matterAt(const Medium& medium, const glm::dvec3& unit) {
  return matterOf(medium.function, valueAt(*medium.grid, unit));
}

/// The brick that a ray is in.
struct BrickPassage {
  double until = 0;    ///< distance along the ray; not before the one that was asked for
  bool filled = false; ///< otherwise nothing is in it
};
BrickPassage brickAt(const Medium& medium, const Ray& unitRay, double distance);

} // namespace gnomon
