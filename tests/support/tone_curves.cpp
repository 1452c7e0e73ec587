#include "tests/support/tone_curves.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gnomon::testing {
namespace {

/// Khronos PBR Neutral Specification (KhronosGroup/ToneMapping), in its own letters.
glm::dvec3 neutral(const glm::dvec3& in) {
  constexpr double f90 = 0.04, ks = 0.8 - f90, kd = 0.15;
  const double x = std::min({in.r, in.g, in.b});
  const double f = x <= 2 * f90 ? x - x * x / (4 * f90) : f90;
  const glm::dvec3 c = in - f;
  const double p = std::max({c.r, c.g, c.b});
  if (p <= ks) return c;
  const double pn = 1 - (1 - ks) * (1 - ks) / (p + 1 - 2 * ks);
  const double g = 1 / (kd * (p - pn) + 1);
  return c * (pn / p) * g + glm::dvec3(pn) * (1 - g);
}

/// The sigmoid of AgX-S2O3 with limits of contrast of 3 and 3.25, slope 2 at the pivot (10 / 16.5, 0.5).
double sigmoid(double x) {
  const double pivot = 10 / 16.5;
  const bool toe = x < pivot;
  const double power = toe ? 3 : 3.25;
  const double width = toe ? pivot : 1 - pivot;
  const double scale =
      std::pow(std::pow(2 * width, -power) * (std::pow(2 * width / 0.5, power) - 1), -1 / power) * (toe ? -1 : 1);
  const double term = 2 * (x - pivot) / scale;
  return scale * term / std::pow(1 + std::pow(term, power), 1 / power) + 0.5;
}

/// Rows; ITU-R BT.2087 for the primaries, Filament's ToneMapper for the inset and the inverse of the outset.
glm::dmat3 byRows(const glm::dvec3& r, const glm::dvec3& g, const glm::dvec3& b) {
  return glm::transpose(glm::dmat3(r, g, b));
}

glm::dvec3 agx(const glm::dvec3& in) {
  const glm::dmat3 wide = byRows({0.627403896, 0.329283038, 0.043313066}, {0.069097289, 0.919540395, 0.011362316},
                                 {0.016391439, 0.088013308, 0.895595253});
  const glm::dmat3 inset = byRows({0.856627153315983, 0.0951212405381588, 0.0482516061458583},
                                  {0.137318972929847, 0.761241990602591, 0.101439036467562},
                                  {0.11189821299995, 0.0767994186031903, 0.811302368396859});
  const glm::dmat3 outset = glm::inverse(byRows({0.899796955911611, 0.0871996192028351, 0.013003424885555},
                                                {0.11142098895748, 0.875575586156966, 0.0130034248855548},
                                                {0.11142098895748, 0.0871996192028349, 0.801379391839686}));
  glm::dvec3 curved = inset * wide * in;
  for (int i = 0; i < 3; ++i) {
    const double stops = std::log2(std::max(curved[i], 1e-10) / 0.18);
    curved[i] = sigmoid((std::clamp(stops, -10.0, 6.5) + 10) / 16.5);
  }
  const glm::dvec3 linear = glm::pow(glm::max(outset * curved, 0.0), glm::dvec3(2.2));
  return glm::clamp(glm::inverse(wide) * linear, 0.0, 1.0);
}

} // namespace

glm::dvec3 publishedTone(ToneMapping tone, const glm::dvec3& light) {
  switch (tone) {
    case ToneMapping::neutral:
      return neutral(light);
    case ToneMapping::agx:
      return agx(light);
    case ToneMapping::none:
      return glm::clamp(light, 0.0, 1.0);
    case ToneMapping::aces:
      break;
  }
  throw std::invalid_argument("There is no published text of aces here.");
}

int srgbByte(double linear) {
  const double encoded = linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
  return static_cast<int>(std::lround(255 * std::clamp(encoded, 0.0, 1.0)));
}

} // namespace gnomon::testing
