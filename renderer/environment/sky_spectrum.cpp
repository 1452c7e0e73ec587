#include "renderer/environment/sky_spectrum.h"

#include <algorithm>
#include <cmath>

#include "renderer/core/light.h"

namespace gnomon {
namespace {

/// CIE 1931 X, Y, Z of a wavelength in nm: Wyman, Sloan and Shirley, "Simple analytic approximations to the CIE XYZ
/// color matching functions", Journal of Computer Graphics Techniques 2 (2), 2013, with several lobes.
glm::dvec3 matchingFunctions(double nm) {
  const auto lobe = [nm](double height, double middle, double before, double after) {
    const double t = (nm - middle) * (nm < middle ? before : after);
    return height * std::exp(-0.5 * t * t);
  };
  return {lobe(0.362, 442.0, 0.0624, 0.0374) + lobe(1.056, 599.8, 0.0264, 0.0323) - lobe(0.065, 501.1, 0.0490, 0.0382),
          lobe(0.821, 568.8, 0.0213, 0.0247) + lobe(0.286, 530.9, 0.0613, 0.0322),
          lobe(1.217, 437.0, 0.0845, 0.0278) + lobe(0.681, 459.0, 0.0385, 0.0725)};
}

/// Of the sun outside of the air, in any unit: a black body of 5778 K, its effective temperature (Planck's law).
double solarPower(double nm) {
  constexpr double kSecondRadiation = 1.438777e7; // nm K
  return 1 / (std::pow(nm / 560, 5) * std::expm1(kSecondRadiation / (nm * 5778)));
}

/// IEC 61966-2-1.
glm::dvec3 linearSrgb(const glm::dvec3& xyz) {
  return {glm::dot(glm::dvec3(3.2404542, -1.5371385, -0.4985314), xyz),
          glm::dot(glm::dvec3(-0.9692660, 1.8760108, 0.0415560), xyz),
          glm::dot(glm::dvec3(0.0556434, -0.2040259, 1.0572252), xyz)};
}

/// What the whole of each band gives.
std::array<glm::dvec3, kBands> bandColors() {
  std::array<glm::dvec3, kBands> xyz{};
  double luminance = 0;
  for (std::size_t band = 0; band < kBands; ++band) {
    for (double nm = -kBandWidth / 2 + 0.5; nm < kBandWidth / 2; nm += 1) {
      const double at = wavelengthOf(band) + nm;
      xyz[band] += solarPower(at) * matchingFunctions(at);
    }
    luminance += xyz[band].y;
  }
  std::array<glm::dvec3, kBands> colors{};
  for (std::size_t band = 0; band < kBands; ++band) colors[band] = linearSrgb(xyz[band] * (kSolarLux / luminance));
  return colors;
}

} // namespace

glm::dvec3 sunlightColor(const Spectrum& share) {
  static const std::array<glm::dvec3, kBands> kColors = bandColors();
  glm::dvec3 color(0.0);
  for (std::size_t band = 0; band < kBands; ++band) color += static_cast<double>(share[band]) * kColors[band];
  return color;
}

glm::dvec3 withinSrgb(const glm::dvec3& color) {
  const double least = std::min({color.r, color.g, color.b});
  if (least >= 0) return color;
  const double luminance = std::max(luminanceOf(color), 0.0);
  const glm::dvec3 paled = luminance + (color - luminance) * (luminance / (luminance - least));
  return glm::max(paled, glm::dvec3(0.0)); // for rounding
}

} // namespace gnomon
