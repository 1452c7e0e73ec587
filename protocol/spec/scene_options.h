#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>

#include "protocol/spec/limits.h"
#include "protocol/spec/shadow_options.h"

/// What a request says about the scene: from where it is seen, what lights it, how its nodes take part.
/// Rows of the fields: scene_rows.h.
namespace gnomon {

using Vec3 = std::array<double, 3>; ///< x y z; metres for points, no unit for directions

/// Placement by the eye and the point that it looks at.
struct EyeTarget {
  Vec3 eye{0, 0, 5};
  Vec3 target{0, 0, 0};
  Vec3 up{0, 1, 0};

  bool operator==(const EyeTarget&) const = default;
};

/// Placement on a sphere around a target.
struct Orbit {
  std::optional<Vec3> target{};
  double azimuthDegrees = 210;
  double elevationDegrees = 20;
  std::optional<double> distance{};

  bool operator==(const Orbit&) const = default;
};

struct Perspective {
  double fovYDegrees = 45;
  std::optional<double> near{};
  std::optional<double> far{};

  bool operator==(const Perspective&) const = default;
};

/// A lens with perspective as calibration gives it. The centre of the upper left pixel is 0 0, so that the middle of a
/// picture is at (width - 1) / 2, (height - 1) / 2, as in OpenCV.
struct Intrinsics {
  double fx = 1000;
  double fy = 1000;
  std::optional<double> cx{};
  std::optional<double> cy{};
  std::optional<double> near{};
  std::optional<double> far{};

  bool operator==(const Intrinsics&) const = default;
};

struct Orthographic {
  double height = 10;
  double near = 0;
  double far = 1000;

  bool operator==(const Orthographic&) const = default;
};

/// Which way the axes of a camera point.
enum class CameraAxes { opengl, opencv };

/// A matrix by rows.
using Rows4 = std::array<std::array<double, 4>, 4>;

/// Placement by a matrix.
struct CameraPose {
  Rows4 worldFromCamera{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
  CameraAxes axes = CameraAxes::opengl;

  bool operator==(const CameraPose&) const = default;
};

/// Exactly one placement and at most one lens. With nothing given: an orbit that shows the whole scene.
struct Camera {
  std::optional<EyeTarget> lookAt{}; ///< JSON: eye, target and up are fields of `camera`
  std::optional<Orbit> orbit{};
  std::optional<std::variant<int, std::string>>
      node{}; ///< a glTF camera: index into the file's nodes, or the name of one
  std::optional<bool> fit{};
  std::optional<CameraPose> pose{};
  std::optional<Perspective> perspective{};
  std::optional<Intrinsics> intrinsics{};
  std::optional<Orthographic> orthographic{};

  bool operator==(const Camera&) const = default;
};

/// Layers are bits: 1 is the first, 2 the second, 4 the third. This is all of them.
inline constexpr int kAllLayers = (1 << kLimits.maxLayers) - 1;

/// Switches of a node and all below it, unless an entry for a node further down overrides them; and its transform,
/// instead of that of the file and its animation. Only one of `matrix` and the three others.
struct NodeOptions {
  std::optional<std::variant<int, std::string>> node{};
  std::optional<bool> visible{};
  std::optional<bool> castShadow{};
  std::optional<bool> receiveShadow{};
  std::optional<int> layers{};
  std::optional<std::array<double, 16>> matrix{};
  std::optional<Vec3> translation{};
  std::optional<std::array<double, 4>> rotation{};
  std::optional<Vec3> scale{};

  bool operator==(const NodeOptions&) const = default;
};

enum class LightType { directional, spot, point };

/// A direction by the sun's place in the sky.
struct Sun {
  double azimuthDegrees = 135;
  double elevationDegrees = 45;

  bool operator==(const Sun&) const = default;
};

struct Light {
  LightType type = LightType::directional;
  std::optional<Vec3> direction{};
  std::optional<Sun> sun{};
  std::optional<Vec3> position{};
  std::optional<double> range{};
  double innerConeDegrees = 0;
  double outerConeDegrees = 45;
  std::optional<double> angularDiameterDegrees{};
  std::optional<double> radius{};
  std::optional<Vec3> color{};
  std::optional<double> temperatureKelvin{};
  double intensity = 3;
  int cullingMask = kAllLayers;
  std::optional<Shadow> shadow{};

  bool operator==(const Light&) const = default;
};

} // namespace gnomon
