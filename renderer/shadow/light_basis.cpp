#include "renderer/shadow/light_basis.h"

#include <cmath>
#include <glm/gtc/constants.hpp>

namespace gnomon {
namespace {

/// The frame that a light straight from `pole` gets; the opposite of `pole` is the direction where the field spins.
struct PoleFrame {
  glm::dvec3 right, up, pole;
};

PoleFrame poleFrame() {
  const double azimuth = glm::radians(37.3);
  const double elevation = glm::radians(11.0);
  const glm::dvec3 pole(std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                        -std::cos(azimuth) * std::cos(elevation));
  const glm::dvec3 right(std::cos(azimuth), 0, std::sin(azimuth));
  return {right, glm::cross(pole, right), pole};
}

} // namespace

// The pole's frame carried to the light along a great circle (Frisvad, "Building an Orthonormal Basis from a 3D Unit
// Vector Without Normalization", 2012). Frisvad's 1 / (1 + z) cancels near z = -1 (Duff et al., "Building an
// Orthonormal Basis, Revisited", 2017); there (1 - z) / (x^2 + y^2), the same number on the unit sphere, does not.
LightBasis lightBasis(const glm::dvec3& direction) {
  const PoleFrame frame = poleFrame();
  const glm::dvec3 towards = -glm::normalize(direction);
  const double x = glm::dot(towards, frame.right);
  const double y = glm::dot(towards, frame.up);
  const double z = glm::dot(towards, frame.pole);
  const double lateral = x * x + y * y;

  glm::dvec3 right(1, 0, 0);
  glm::dvec3 up(0, -1, 0);
  if (z > 0.0 || lateral > 1e-300) {
    const double s = z > 0.0 ? 1.0 / (1.0 + z) : (1.0 - z) / lateral;
    right = {1.0 - x * x * s, -x * y * s, -x};
    up = {-x * y * s, 1.0 - y * y * s, -y};
  }
  const glm::dmat3 worldFromPole(frame.right, frame.up, frame.pole);
  return {worldFromPole * right, worldFromPole * up, -towards};
}

} // namespace gnomon
