#pragma once

#include <optional>
#include <string>

#include "protocol/spec/camera.h"
#include "protocol/spec/node_options.h"
#include "protocol/spec/shadow_options.h"

namespace gnomon {

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
