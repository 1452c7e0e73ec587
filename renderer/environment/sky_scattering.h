#pragma once

#include <vector>

#include "renderer/environment/sky_air.h"

/// What the air scatters towards an eye, by Hillaire, "A Scalable and Production Ready Sky and Atmosphere Rendering
/// Technique" (2020): single scattering exactly, all further scattering as if it were the same in all directions. Light
/// is a share of the sun's irradiance outside of the air.
namespace gnomon {

/// One ray through the air. The z axis points up from the ground, and the sun stands over the x axis.
struct AirRay {
  double height = 0; ///< metres above the ground, where it begins
  glm::dvec3 direction{0, 0, 1};
};

/// The sky's radiance in one direction, a steradian.
struct ScatteredLight {
  Spectrum once{};      ///< by molecules, to be multiplied by their phase function
  Spectrum onceHaze{};  ///< by haze, to be multiplied by its phase function
  Spectrum moreOften{}; ///< whole
};

class ScatteringAir {
 public:
  /// `towardsSun`: in the space of rays. `albedo`: of the ground.
  ScatteringAir(const AirCoefficients& air, const glm::dvec3& towardsSun, const Spectrum& albedo);

  /// REQUIRES: the ray does not meet the ground.
  ScatteredLight along(const AirRay& ray) const;

 private:
  Spectrum moreOftenOf(const AirPlace& place, const Spectrum& albedo) const;
  Spectrum moreOftenAt(const AirPlace& place) const;
  double sunSineOfColumn(std::size_t column) const;

  AirCoefficients air_;
  glm::dvec3 towardsSun_;
  SunColumns columns_;
  std::vector<Spectrum> moreOften_; ///< rows of one height, columns of one sun
};

} // namespace gnomon
