#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "protocol/spec/limits.h"
#include "protocol/spec/shadow_options.h"

/// What a request says about the scene: from where it is seen, what lights it, how its nodes take part, its volumes.
/// Rows of the fields: scene_rows.h and field_rows.h.
namespace gnomon {

using Vec3 = std::array<double, 3>; ///< x y z; metres for points, no unit for directions

struct EyeTarget {
  Vec3 eye{0, 0, 5};
  Vec3 target{0, 0, 0};
  Vec3 up{0, 1, 0};

  bool operator==(const EyeTarget&) const = default;
};

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

inline constexpr double kUsualSunAzimuth = 135;  ///< degrees
inline constexpr double kUsualSunElevation = 45; ///< degrees
inline constexpr double kUsualSunIntensity = 2;  ///< lux, where neither the request nor the scene has lights

/// Azimuth and elevation, or all of latitude, longitude and time.
struct Sun {
  std::optional<double> azimuthDegrees{};
  std::optional<double> elevationDegrees{};
  std::optional<double> latitudeDegrees{};
  std::optional<double> longitudeDegrees{};
  std::optional<std::string> time{};
  std::optional<double> northDegrees{};

  bool operator==(const Sun&) const = default;
};

/// What view sunHours adds up; `begin` and `end` as Sun::time.
struct SunHours {
  std::optional<double> latitudeDegrees{};
  std::optional<double> longitudeDegrees{};
  std::optional<double> northDegrees{};
  std::string begin{};
  std::string end{};
  double stepMinutes = 10;
  int stepDays = 1;

  bool operator==(const SunHours&) const = default;
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
