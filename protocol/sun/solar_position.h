#pragma once

#include "protocol/sun/moment.h"

/// Where the sun stands in the sky. Good to 0.006 degrees from 1900 to 2100, apart from refraction, as tests hold
/// against an independent ephemeris (tests/protocol/sun).
namespace gnomon {

/// A place on Earth, and the air there.
struct Observer {
  double latitudeDegrees = 0;  ///< north is positive
  double longitudeDegrees = 0; ///< east is positive
  double heightMetres = 0;     ///< above the sea
  double pressureMillibar = 1010;
  double temperatureCelsius = 10;
};

struct SolarPosition {
  double azimuthDegrees = 0;       ///< clockwise from true north, 0..360
  double elevationDegrees = 0;     ///< of the disc's centre above the horizon, raised by refraction
  double trueElevationDegrees = 0; ///< the same without air
};

/// As seen from the place, not from the Earth's centre. UT1 is taken to be UTC, which is right to 0.9 seconds (0.004
/// degrees of azimuth at noon in the tropics, less elsewhere).
SolarPosition solarPosition(const Moment& moment, const Observer& observer);

/// Terrestrial time minus universal time, seconds. Polynomials of Espenak and Meeus ("Five Millennium Canon of Solar
/// Eclipses", NASA/TP-2006-214141), years 1900 to 2150. `year`: with its fraction.
double deltaTSeconds(double year);

/// What the air adds to an elevation without air, degrees: Saemundsson, "Astronomical refraction", Sky and Telescope
/// 72 (1986), scaled for pressure and temperature, as NREL's algorithm has it. Below -0.8333 degrees, where the disc is
/// out of sight, it falls off towards 0 in proportion to 1 / elevation, so that the sun's path has no jump.
double refractionDegrees(double trueElevationDegrees, double pressureMillibar, double temperatureCelsius);

} // namespace gnomon
