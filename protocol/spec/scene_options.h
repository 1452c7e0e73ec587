#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>

#include "protocol/spec/limits.h"
#include "protocol/spec/shadow_options.h"

/// What a request says about the scene: from where it is seen, what lights it, how its nodes take part.
namespace gnomon {

using Vec3 = std::array<double, 3>; ///< x y z; metres for points, no unit for directions

/// Placement by where the eye stands and what it looks at.
struct EyeTarget {
  Vec3 eye{0, 0, 5};
  Vec3 target{0, 0, 0};
  Vec3 up{0, 1, 0}; ///< must not be parallel to the view direction

  bool operator==(const EyeTarget&) const = default;
};

/// Placement on a sphere around a target.
struct Orbit {
  std::optional<Vec3> target{};     ///< absent = the centre of the scene's bounds
  double azimuthDegrees = 210;      ///< of the eye seen from the target, clockwise from north (-Z) seen from above
  double elevationDegrees = 20;     ///< of the eye above the horizon, -90..90
  std::optional<double> distance{}; ///< metres; absent = far enough for the whole scene

  bool operator==(const Orbit&) const = default;
};

struct Perspective {
  double fovYDegrees = 45;      ///< full vertical angle, > 0 and < 180
  std::optional<double> near{}; ///< metres; absent = from the scene's bounds
  std::optional<double> far{};  ///< metres; absent = infinite

  bool operator==(const Perspective&) const = default;
};

/// A lens with perspective as calibration gives it. The centre of the upper left pixel is 0 0, so that the middle of a
/// picture is at (width - 1) / 2, (height - 1) / 2, as in OpenCV.
struct Intrinsics {
  double fx = 1000;             ///< focal lengths, pixels
  double fy = 1000;             ///< pixels
  std::optional<double> cx{};   ///< principal point, pixels from the left; absent = the middle
  std::optional<double> cy{};   ///< pixels from the top; absent = the middle
  std::optional<double> near{}; ///< metres; absent = from the scene's bounds
  std::optional<double> far{};  ///< metres; absent = infinite

  bool operator==(const Intrinsics&) const = default;
};

struct Orthographic {
  double height = 10; ///< metres from the lower to the upper edge of the picture
  double near = 0;    ///< metres; may be negative
  double far = 1000;  ///< metres, > near

  bool operator==(const Orthographic&) const = default;
};

/// Which way the axes of a camera point.
enum class CameraAxes { opengl, opencv };

/// A matrix by rows.
using Rows4 = std::array<std::array<double, 4>, 4>;

/// Placement by a matrix.
struct CameraPose {
  /// Takes points of the camera's space into the world: a rotation and a translation in metres, by rows.
  Rows4 worldFromCamera{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
  CameraAxes axes = CameraAxes::opengl;

  bool operator==(const CameraPose&) const = default;
};

/// Exactly one placement and at most one lens. With nothing given: an orbit that shows the whole scene.
struct Camera {
  std::optional<EyeTarget> lookAt{}; ///< JSON: eye, target and up stand directly in `camera`
  std::optional<Orbit> orbit{};
  std::optional<std::variant<int, std::string>>
      node{};                ///< a glTF camera: index into the file's nodes, or the name of one
  std::optional<bool> fit{}; ///< true = frame the whole scene from the default direction
  std::optional<CameraPose> pose{};
  std::optional<Perspective> perspective{};
  std::optional<Intrinsics> intrinsics{};
  std::optional<Orthographic> orthographic{};

  bool operator==(const Camera&) const = default;
};

/// Layers are bits: 1 is the first, 2 the second, 4 the third. This is all of them.
inline constexpr int kAllLayers = (1 << kLimits.maxLayers) - 1;

/// Switches of a node of the scene and of all below it, as far as no entry for a node further down says otherwise; and
/// where it stands, instead of where the file and its animation put it. Only one of `matrix` and the three others.
struct NodeOptions {
  std::optional<std::variant<int, std::string>> node{}; ///< index into the file's nodes, or the name of some; needed
  std::optional<bool> visible{};                        ///< false = the camera doesn't see it
  std::optional<bool> castShadow{};                     ///< absent = as visible: what isn't seen throws no shadow
  std::optional<bool> receiveShadow{};                  ///< false = it is lit as if nothing threw a shadow on it
  std::optional<int> layers{};                          ///< one bit a layer, at least one; absent = the first, 1
  std::optional<std::array<double, 16>> matrix{};       ///< into the space of its parent, affine, column by column
  std::optional<Vec3> translation{};                    ///< metres, in the space of its parent
  std::optional<std::array<double, 4>> rotation{};      ///< quaternion x y z w, of any length but zero
  std::optional<Vec3> scale{};                          ///< along its own axes

  bool operator==(const NodeOptions&) const = default;
};

enum class LightType { directional, spot, point };

/// A direction by the sun's place in the sky.
struct Sun {
  double azimuthDegrees = 135;  ///< clockwise from north (-Z) seen from above
  double elevationDegrees = 45; ///< above the horizon, -90..90

  bool operator==(const Sun&) const = default;
};

struct Light {
  LightType type = LightType::directional;
  std::optional<Vec3> direction{}; ///< where the light travels; directional and spot. Not zero
  std::optional<Sun> sun{};        ///< directional only, instead of direction
  std::optional<Vec3> position{};  ///< metres; spot and point
  std::optional<double> range{};   ///< metres; spot and point; absent = infinite
  double innerConeDegrees = 0;     ///< half angle; spot
  double outerConeDegrees = 45;    ///< half angle; spot, > inner, < 90
  /// Directional: the angle that its disc spans in the sky; absent = 0. The sun's is 0.53.
  std::optional<double> angularDiameterDegrees{};
  std::optional<double> radius{};            ///< metres, of a shining ball; spot and point; absent = 0
  std::optional<Vec3> color{};               ///< linear RGB, 0..1; absent = white, or by temperatureKelvin
  std::optional<double> temperatureKelvin{}; ///< of a black body that glows in the light's color; instead of color
  double intensity = 3;                      ///< lux (directional) or candela (spot, point)
  int cullingMask = kAllLayers;   ///< one bit a layer: the layers of nodes that it lights and that cast from it
  std::optional<Shadow> shadow{}; ///< absent = the frame's `shadow`

  bool operator==(const Light&) const = default;
};

} // namespace gnomon
