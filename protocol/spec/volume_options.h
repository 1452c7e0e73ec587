#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "protocol/spec/scene_options.h"

namespace gnomon {

/// A box along the world's axes.
struct VolumeBox {
  Vec3 min{0, 0, 0}; ///< metres
  Vec3 max{1, 1, 1}; ///< metres, more than min along each axis

  bool operator==(const VolumeBox&) const = default;
};

/// What a value of the grid means.
struct TransferStop {
  double value = 0;      ///< of the grid, more than that of the stop before
  Vec3 color{1, 1, 1};   ///< linear RGB, 0..1: the share of the light that is scattered of what is taken away
  double extinction = 0; ///< what is taken away, per metre

  bool operator==(const TransferStop&) const = default;
};

/// A cloud, smoke or fog: numbers on a grid, placed in the scene. At least one of `node`, `box` and `matrix`, and not
/// both of the last two.
struct VolumeOptions {
  std::string file{};                ///< of the upload, .npy or .vdb; needed
  std::optional<std::string> grid{}; ///< of a .vdb, by name; absent = its only float grid
  /// Index into the file's nodes, or the name of one: `box` and `matrix` are in its space, and not in the world.
  /// Without both the grid fills the unit cube of that space.
  std::optional<std::variant<int, std::string>> node{};
  std::optional<VolumeBox> box{};
  std::optional<std::array<double, 16>> matrix{}; ///< from the grid's unit cube, affine, column by column
  std::vector<TransferStop> transferFunction{};   ///< at least one; linear between them, the ends' values beyond
  bool castShadow = true;                         ///< on surfaces and volumes, itself among them
  bool receiveShadow = true;                      ///< from surfaces and volumes, itself among them

  bool operator==(const VolumeOptions&) const = default;
};

} // namespace gnomon
