#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "protocol/spec/scene_options.h"

/// Rows of the fields: volume_rows.h.
namespace gnomon {

/// A box along the world's axes.
struct VolumeBox {
  Vec3 min{0, 0, 0};
  Vec3 max{1, 1, 1};

  bool operator==(const VolumeBox&) const = default;
};

/// What a value of the grid means.
struct TransferStop {
  double value = 0;
  Vec3 color{1, 1, 1};
  double extinction = 0;

  bool operator==(const TransferStop&) const = default;
};

/// A cloud, smoke or fog: numbers on a grid, placed in the scene. At least one of `node`, `box` and `matrix`, and not
/// both of the last two.
struct VolumeOptions {
  std::string file{};
  std::optional<std::string> grid{};
  std::optional<std::variant<int, std::string>> node{};
  std::optional<VolumeBox> box{};
  std::optional<std::array<double, 16>> matrix{};
  std::vector<TransferStop> transferFunction{};
  bool castShadow = true;
  bool receiveShadow = true;

  bool operator==(const VolumeOptions&) const = default;
};

} // namespace gnomon
