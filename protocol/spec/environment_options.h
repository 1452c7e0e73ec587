#pragma once

#include <optional>
#include <string>

#include "protocol/spec/scene_options.h"

/// What a request says about the light that comes from everywhere, and about the ground under the scene. Rows of the
/// fields: environment_rows.h.
namespace gnomon {

/// A clear sky with its sun.
struct Sky {
  double turbidity = 3;
  Vec3 albedo{0.2, 0.2, 0.2};
  Sun sun{};

  bool operator==(const Sky&) const = default;
};

enum class EnvironmentBackground { none, environment, blurred };
enum class Studio { lamps, even };
enum class EnvironmentShadows { none, rays };
enum class SunExtraction { auto_, none, removed };

/// At most one of `file`, `sky` and `light`. With none of them and without `studio`, the light of the frame's scene
/// where the glTF has one, else the studio of `ambient`, with lamps.
struct EnvironmentOptions {
  std::optional<std::string> file{};
  std::optional<Sky> sky{};
  std::optional<int> light{};
  std::optional<Studio> studio{};
  double rotationDegrees = 0;
  std::optional<double> intensity{};
  EnvironmentBackground background = EnvironmentBackground::none;
  EnvironmentShadows shadows = EnvironmentShadows::none;
  int samples = 4; ///< rays a pixel at first
  SunExtraction extractSun = SunExtraction::auto_;

  bool operator==(const EnvironmentOptions&) const = default;
};

enum class GroundMode { catcher, surface };

/// A horizontal plane under the scene.
struct Ground {
  std::optional<double> height{};
  GroundMode mode = GroundMode::catcher;
  Vec3 color{0.5, 0.5, 0.5};
  double roughness = 1;
  std::optional<double> size{};

  bool operator==(const Ground&) const = default;
};

} // namespace gnomon
