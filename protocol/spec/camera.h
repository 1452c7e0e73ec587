#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>

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

struct Orthographic {
  double height = 10; ///< metres from the lower to the upper edge of the picture
  double near = 0;    ///< metres; may be negative
  double far = 1000;  ///< metres, > near

  bool operator==(const Orthographic&) const = default;
};

/// Exactly one placement and at most one lens. With nothing given: an orbit that shows the whole scene.
struct Camera {
  std::optional<EyeTarget> lookAt{}; ///< JSON: eye, target and up stand directly in `camera`
  std::optional<Orbit> orbit{};
  std::optional<std::variant<int, std::string>>
      node{};                ///< a glTF camera: index into the file's nodes, or the name of one
  std::optional<bool> fit{}; ///< true = frame the whole scene from the default direction
  std::optional<Perspective> perspective{};
  std::optional<Orthographic> orthographic{};

  bool operator==(const Camera&) const = default;
};

} // namespace gnomon
