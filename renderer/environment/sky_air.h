#pragma once

#include <vector>

#include "renderer/environment/sky_spectrum.h"

/// The air of a clear sky: how much of what lies where, and how much of the sun's light gets through it.
namespace gnomon {

inline constexpr double kEarthRadius = 6'360'000; ///< metres
inline constexpr double kAirTop = 100'000;        ///< metres above the ground; beyond it is nothing
inline constexpr double kSunRadians = 0.00925;    ///< the disc's diameter, 0.53 degrees

/// How much lies along a way, in metres of what lies at sea level (of ozone: of its densest layer).
struct AirColumn {
  double molecules = 0, haze = 0, ozone = 0;

  AirColumn operator*(double by) const { return {molecules * by, haze * by, ozone * by}; }
  AirColumn operator+(const AirColumn& other) const {
    return {molecules + other.molecules, haze + other.haze, ozone + other.ozone};
  }
};

/// Of a metre at that height above the ground.
AirColumn densityAt(double height);

/// What a metre of each does to light, per metre.
struct AirCoefficients {
  Spectrum molecules{};    ///< scattered; nothing is absorbed
  Spectrum hazeScatter{};  ///< scattered
  Spectrum hazeLoss{};     ///< scattered and absorbed
  Spectrum ozoneAbsorbs{}; ///< absorbed
};

/// Rayleigh scattering and ozone of Bruneton and Neyret, "Precomputed Atmospheric Scattering" (2008; ozone as in its
/// implementation of 2017). Haze: Angstrom's law with the mapping of turbidity T of Preetham, Shirley and Smits, "A
/// Practical Analytic Model for Daylight" (1999): vertical optical depth (0.04608 T - 0.04586) (nm / 1000)^-1.3, which
/// is 0.2 at 550 nm for T = 3; a tenth of it is absorbed.
AirCoefficients coefficientsOf(double turbidity);

/// Where a point is and how it stands to the sun: all that matters of it on a round Earth.
struct AirPlace {
  double height = 0;  ///< metres above the ground
  double sunSine = 0; ///< of the sun's elevation above the plane across the vertical
};

/// The share of a way's light that is left after it.
Spectrum transmittance(const AirCoefficients& air, const AirColumn& column);

/// From a height along a way at that elevation (radians, above the plane across the vertical) to the end of the air.
/// What is in the way is not asked.
AirColumn columnAlong(double height, double elevation);

/// The share of the sun's disc that the Earth does not hide.
double visibleDisc(const AirPlace& place);

/// The columns between points and the sun, as a table.
class SunColumns {
 public:
  SunColumns();

  /// The share of the sun's light that arrives, by band. 0 behind the Earth; where it hides a part of the disc, that
  /// part is missing.
  Spectrum sunlight(const AirCoefficients& air, const AirPlace& place) const;

 private:
  AirColumn columnAt(double height, double aboveHorizon) const;

  std::vector<AirColumn> columns_; ///< rows of one height; see columnAt
};

} // namespace gnomon
