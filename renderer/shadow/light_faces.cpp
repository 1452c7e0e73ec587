#include "renderer/shadow/light_faces.h"

#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace gnomon {
namespace {

/// The six faces of a cube whose first one looks along `front.direction`.
std::array<LightBasis, 6> cubeFaces(const LightBasis& front) {
  const glm::dvec3 a = front.direction;
  const glm::dvec3 b = front.up;
  const glm::dvec3 c = front.right; // b x c = a
  return {{{c, b, a}, {a, c, b}, {b, a, c}, {c, a, -b}, {a, b, -c}, {b, c, -a}}};
}

/// The angle from a cube's first axis at which its side faces begin.
constexpr double kSidesBegin = glm::pi<double>() / 4;

} // namespace

double widestSingleTile() {
  return glm::radians(60.0);
}

std::vector<LightFace> facesOf(const ShadowCaster& light) {
  if (light.type == LightType::spot && light.outerCone <= widestSingleTile()) {
    return {{lightBasis(light.direction), std::tan(light.outerCone)}};
  }
  const bool spot = light.type == LightType::spot;
  const LightBasis front = spot ? lightBasis(light.direction) : LightBasis{};
  const std::array<LightBasis, 6> cube = cubeFaces(front);
  static_assert(kSidesBegin < glm::pi<double>() / 3); // every spot that comes here is wider
  const std::size_t count = spot ? 5 : 6;             // no cone narrower than a half space reaches the back
  std::vector<LightFace> faces;
  for (std::size_t i = 0; i < count; ++i) faces.push_back({cube[i], 1.0});
  return faces;
}

} // namespace gnomon
