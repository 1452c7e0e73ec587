#include "protocol/sun/solar_position.h"

#include <algorithm>
#include <cmath>
#include <numbers>

// Formulae and constants are those of Meeus, "Astronomical Algorithms" (2nd edition, 1998), of the chapters that are
// named, unless said otherwise.

namespace gnomon {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

double sine(double degrees) {
  return std::sin(degrees * kDegree);
}

double cosine(double degrees) {
  return std::cos(degrees * kDegree);
}

double within360(double degrees) {
  const double rest = std::fmod(degrees, 360.0);
  return rest < 0 ? rest + 360 : rest;
}

/// Of the sun as seen from the Earth's centre, of date, without nutation and aberration.
struct Geometric {
  double longitudeDegrees, distanceAu;
};

/// Chapter 25. Periodic terms of Venus, Jupiter and the Moon, and one of long period: Meeus, "Astronomical Formulae for
/// Calculators" (1979), chapter 18, moved from 1900 to 2000. `t`: Julian centuries of terrestrial time since 2000.
Geometric sunFromEarth(double t) {
  const double meanLongitude = 280.46646 + t * (36000.76983 + t * 0.0003032);
  const double anomaly = 357.52911 + t * (35999.05029 - t * 0.0001537);
  const double eccentricity = 0.016708634 - t * (0.000042037 + t * 0.0000001267);
  const double center = (1.914602 - t * (0.004817 + t * 0.000014)) * sine(anomaly) +
                        (0.019993 - t * 0.000101) * sine(2 * anomaly) + 0.000289 * sine(3 * anomaly);
  const double since1900 = t + 1;
  const double planets = 0.00134 * cosine(153.23 + 22518.7541 * since1900) +
                         0.00154 * cosine(216.57 + 45037.5082 * since1900) +
                         0.00200 * cosine(312.69 + 32964.3577 * since1900) +
                         0.00179 * sine(350.74 + 445267.1142 * since1900) + 0.00178 * sine(231.19 + 20.20 * since1900);
  const double distance =
      1.000001018 * (1 - eccentricity * eccentricity) / (1 + eccentricity * cosine(anomaly + center));
  return {meanLongitude + center + planets, distance};
}

struct Nutation {
  double longitudeDegrees, obliquityDegrees;
};

/// Chapter 22: the largest terms, right to half a second of arc.
Nutation nutationAt(double t) {
  const double node = 125.04452 - t * 1934.136261;
  const double sun = 280.4665 + t * 36000.7698;
  const double moon = 218.3165 + t * 481267.8813;
  return {(-17.20 * sine(node) - 1.32 * sine(2 * sun) - 0.23 * sine(2 * moon) + 0.21 * sine(2 * node)) / 3600,
          (9.20 * cosine(node) + 0.57 * cosine(2 * sun) + 0.10 * cosine(2 * moon) - 0.09 * cosine(2 * node)) / 3600};
}

/// Greenwich, of the mean equinox; chapter 12. `days`: of universal time since noon of 2000-01-01.
double meanSiderealDegrees(double days) {
  const double t = days / 36525;
  return 280.46061837 + 360.98564736629 * days + t * t * (0.000387933 - t / 38710000);
}

/// Of the observer, in radii of the equator; chapter 11.
struct FromCentre {
  double alongEquator, alongAxis;
};

FromCentre placeOf(const Observer& observer) {
  constexpr double kFlattening = 1 / 298.257223563; // WGS 84
  constexpr double kEquatorMetres = 6378137;
  const double latitude = observer.latitudeDegrees * kDegree;
  const double reduced = std::atan2((1 - kFlattening) * std::sin(latitude), std::cos(latitude));
  const double height = observer.heightMetres / kEquatorMetres;
  return {std::cos(reduced) + height * std::cos(latitude),
          (1 - kFlattening) * std::sin(reduced) + height * std::sin(latitude)};
}

struct Vector {
  double x, y, z;
};

} // namespace

double deltaTSeconds(double year) {
  const auto polynomial = [](double u, auto... terms) {
    double sum = 0, power = 1;
    (..., (sum += terms * power, power *= u));
    return sum;
  };
  if (year < 1920) return polynomial(year - 1900, -2.79, 1.494119, -0.0598939, 0.0061966, -0.000197);
  if (year < 1941) return polynomial(year - 1920, 21.20, 0.84493, -0.076100, 0.0020936);
  if (year < 1961) return polynomial(year - 1950, 29.07, 0.407, -1.0 / 233, 1.0 / 2547);
  if (year < 1986) return polynomial(year - 1975, 45.45, 1.067, -1.0 / 260, -1.0 / 718);
  if (year < 2005) {
    return polynomial(year - 2000, 63.86, 0.3345, -0.060374, 0.0017275, 0.000651814, 0.00002373599);
  }
  if (year < 2050) return polynomial(year - 2000, 62.92, 0.32217, 0.005589);
  const double centuries = (year - 1820) / 100;
  return -20 + 32 * centuries * centuries - 0.5628 * (2150 - year);
}

double refractionDegrees(double trueElevationDegrees, double pressureMillibar, double temperatureCelsius) {
  constexpr double kOutOfSight = -0.8333; // half a disc and what the air lifts at the horizon
  const double elevation = std::max(trueElevationDegrees, kOutOfSight);
  const double lifted = 1.02 / 60 / std::tan((elevation + 10.3 / (elevation + 5.11)) * kDegree) *
                        (pressureMillibar / 1010) * (283 / (273 + temperatureCelsius));
  if (trueElevationDegrees < kOutOfSight) return lifted * kOutOfSight / trueElevationDegrees;
  return std::max(0.0, lifted); // the formula is a little negative at the zenith
}

SolarPosition solarPosition(const Moment& moment, const Observer& observer) {
  const double days = static_cast<double>(moment.milliseconds) / 86'400'000 - 10957.5; // since noon of 2000-01-01
  const double t = (days + deltaTSeconds(2000 + days / 365.25) / 86'400) / 36525;

  const Geometric sun = sunFromEarth(t);
  const Nutation nutation = nutationAt(t);
  const double aberration = -20.4898 / 3600 / sun.distanceAu;
  const double longitude = sun.longitudeDegrees + nutation.longitudeDegrees + aberration;
  const double meanObliquity = 23.4392911 - t * (46.8150 + t * (0.00059 - t * 0.001813)) / 3600;
  const double obliquity = meanObliquity + nutation.obliquityDegrees;

  // Towards the sun, of length 1 = its distance: x to the equator's crossing with the observer's meridian, y to the
  // east, z to the north.
  const double sidereal =
      meanSiderealDegrees(days) + nutation.longitudeDegrees * cosine(obliquity) + observer.longitudeDegrees;
  const double ascension = std::atan2(sine(longitude) * cosine(obliquity), cosine(longitude)) / kDegree;
  const double sineOfDeclination = sine(obliquity) * sine(longitude);
  const double cosineOfDeclination = std::sqrt(1 - sineOfDeclination * sineOfDeclination);
  const double hourAngle = within360(sidereal) - ascension;
  const FromCentre place = placeOf(observer);
  const double earthRadius = std::sin(8.794 / 3600 * kDegree) / sun.distanceAu; // in distances of the sun; chapter 40
  const Vector towards{cosineOfDeclination * cosine(hourAngle) - earthRadius * place.alongEquator,
                       -cosineOfDeclination * sine(hourAngle), sineOfDeclination - earthRadius * place.alongAxis};

  const double up = cosine(observer.latitudeDegrees) * towards.x + sine(observer.latitudeDegrees) * towards.z;
  const double north = -sine(observer.latitudeDegrees) * towards.x + cosine(observer.latitudeDegrees) * towards.z;
  const double elevation = std::atan2(up, std::hypot(north, towards.y)) / kDegree;
  return {within360(std::atan2(towards.y, north) / kDegree),
          elevation + refractionDegrees(elevation, observer.pressureMillibar, observer.temperatureCelsius), elevation};
}

} // namespace gnomon
