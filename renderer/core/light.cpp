#include "renderer/core/light.h"

#include <algorithm>
#include <cmath>

#include "protocol/spec/settled_sun.h"
#include "protocol/spec/traits.h"
#include "renderer/core/linear_algebra.h"

namespace gnomon {
namespace {

/// The Planckian locus in CIE 1960 u, v, within 9e-5 of it from 1000 to 15000 K (Krystek, "An algorithm to calculate
/// correlated color temperature", Color Research & Application 10, 1985).
glm::dvec2 planckianLocus(double kelvin) {
  const double square = kelvin * kelvin;
  return {(0.860117757 + 1.54118254e-4 * kelvin + 1.28641212e-7 * square) /
              (1.0 + 8.42420235e-4 * kelvin + 7.08145163e-7 * square),
          (0.317398726 + 4.22806245e-5 * kelvin + 4.20481691e-8 * square) /
              (1.0 - 2.89741816e-5 * kelvin + 1.61456053e-7 * square)};
}

/// CIE 1931 X, Y, Z of luminance 1, from CIE 1960 u, v.
glm::dvec3 xyzOf(const glm::dvec2& uv) {
  const double scale = 2.0 * uv.x - 8.0 * uv.y + 4.0;
  const double x = 3.0 * uv.x / scale;
  const double y = 2.0 * uv.y / scale;
  return {x / y, 1.0, (1.0 - x - y) / y};
}

/// IEC 61966-2-1.
glm::dvec3 linearSrgbOf(const glm::dvec3& xyz) {
  return {glm::dot(glm::dvec3(3.2404542, -1.5371385, -0.4985314), xyz),
          glm::dot(glm::dvec3(-0.9692660, 1.8760108, 0.0415560), xyz),
          glm::dot(glm::dvec3(0.0556434, -0.2040259, 1.0572252), xyz)};
}

} // namespace

double radiusOf(const Light& light) {
  if (!traitsOf(light.type).parallel) return light.radius.value_or(0.0);
  return std::tan(0.5 * glm::radians(light.angularDiameterDegrees.value_or(0.0)));
}

glm::dvec3 towardsSun(const Sun& sun) {
  const Sun settled = settledSun(sun);
  const double azimuth = glm::radians(*settled.azimuthDegrees);
  const double elevation = glm::radians(*settled.elevationDegrees);
  return {std::sin(azimuth) * std::cos(elevation), std::sin(elevation), -std::cos(azimuth) * std::cos(elevation)};
}

glm::dvec3 directionOf(const Light& light) {
  if (light.sun) {
    return -towardsSun(*light.sun);
  }
  if (light.direction) {
    const glm::dvec3 direction = toVector(*light.direction);
    const double largest = std::max({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)});
    return glm::normalize(direction / largest);
  }
  return {0, -1, 0};
}

double luminanceOf(const glm::dvec3& color) {
  return glm::dot(glm::dvec3(0.2126, 0.7152, 0.0722), color);
}

glm::dvec3 arrivingShare(const glm::dvec3& open, const glm::dvec3& arriving) {
  const double weight = luminanceOf(open);
  if (!(weight > 0)) return glm::dvec3(1);
  glm::dvec3 share;
  for (int i = 0; i < 3; ++i) {
    const double own = open[i] > 0 ? arriving[i] / open[i] : luminanceOf(arriving) / weight;
    share[i] = std::clamp(own, 0.0, 1.0);
  }
  return share;
}

glm::dvec3 blackBodyColor(double kelvin) {
  const glm::dvec3 color = glm::max(linearSrgbOf(xyzOf(planckianLocus(kelvin))), glm::dvec3(0.0));
  return color / luminanceOf(color);
}

} // namespace gnomon
