#include "protocol/sun/solar_position.h"

#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <numbers>
#include <sstream>

namespace gnomon {
namespace {

SolarPosition sunAt(const char* time, double latitude, double longitude) {
  return solarPosition(*readMoment(time), {.latitudeDegrees = latitude, .longitudeDegrees = longitude});
}

/// Great circle between two places in the sky, degrees; small ones.
double apart(double azimuth, double elevation, double otherAzimuth, double otherElevation) {
  const double across = std::remainder(azimuth - otherAzimuth, 360.0) * std::cos(elevation * std::numbers::pi / 180);
  return std::hypot(across, elevation - otherElevation);
}

// Reda and Andreas, "Solar Position Algorithm for Solar Radiation Applications", NREL/TP-560-34302, table A5.1.
TEST(SolarPosition, AgreesWithTheExampleOfNrel) {
  const SolarPosition sun =
      solarPosition(*readMoment("2003-10-17T12:30:30-07:00"), {39.742476, -105.1786, 1830.14, 820, 11});
  EXPECT_NEAR(90 - sun.elevationDegrees, 50.11162, 0.001);
  EXPECT_NEAR(sun.azimuthDegrees, 194.34024, 0.001);
}

TEST(SolarPosition, AgreesWithAnIndependentEphemerisOverTwoCenturies) {
  std::ifstream file(GNOMON_SUN_REFERENCE);
  std::string line;
  std::getline(file, line);
  int rows = 0;
  for (; std::getline(file, line); ++rows) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream words(line);
    std::string time;
    double latitude = 0, longitude = 0, azimuth = 0, elevation = 0;
    ASSERT_TRUE(words >> time >> latitude >> longitude >> azimuth >> elevation) << line;
    const SolarPosition sun = sunAt(time.c_str(), latitude, longitude);
    EXPECT_LT(apart(azimuth, elevation, sun.azimuthDegrees, sun.trueElevationDegrees), 0.006) << line;
  }
  EXPECT_EQ(rows, 411);
}

TEST(SolarPosition, StandsInTheNorthOfTheSouthAndOverTheEquator) {
  EXPECT_NEAR(std::remainder(sunAt("2026-12-21T13:00:00+11:00", -33.86, 151.21).azimuthDegrees, 360), -9, 1);
  EXPECT_GT(sunAt("2026-03-20T12:07:30Z", 0, 0).elevationDegrees, 89.8);
}

TEST(SolarPosition, NeitherRisesNorSetsNearThePoles) {
  for (int hour = 0; hour < 24; ++hour) {
    const std::string of = (hour < 10 ? "T0" : "T") + std::to_string(hour) + ":00Z";
    EXPECT_GT(sunAt(("2026-06-21" + of).c_str(), 69.65, 18.96).elevationDegrees, 2.5) << hour;
    EXPECT_LT(sunAt(("2026-12-21" + of).c_str(), 69.65, 18.96).elevationDegrees, -2) << hour;
    EXPECT_NEAR(sunAt(("2026-06-21" + of).c_str(), 90, 0).trueElevationDegrees, 23.435, 0.01) << hour;
  }
}

TEST(SolarPosition, TheDateLineIsNoStep) {
  const SolarPosition west = sunAt("2026-06-21T00:00:00Z", -16.8, 180),
                      east = sunAt("2026-06-21T00:00:00Z", -16.8, -180);
  EXPECT_NEAR(west.azimuthDegrees, east.azimuthDegrees, 1e-9);
  EXPECT_NEAR(west.elevationDegrees, east.elevationDegrees, 1e-9);
}

// A day in steps of ten seconds: the sun moves 0.042 degrees in each, and refraction moves it less than as much again.
TEST(SolarPosition, ItsPathHasNoJump) {
  SolarPosition before = sunAt("2026-03-20T00:00:00Z", 48.1, 11.6);
  const Moment start = *readMoment("2026-03-20T00:00:00Z");
  for (int step = 1; step <= 8640; ++step) {
    const SolarPosition sun = solarPosition({start.milliseconds + step * 10'000, 0}, {48.1, 11.6});
    EXPECT_LT(apart(before.azimuthDegrees, before.elevationDegrees, sun.azimuthDegrees, sun.elevationDegrees), 0.06)
        << step;
    before = sun;
  }
}

// Espenak and Meeus give these for the starts of the years.
TEST(DeltaT, IsThatOfTheTables) {
  EXPECT_NEAR(deltaTSeconds(1900), -2.8, 0.1);
  EXPECT_NEAR(deltaTSeconds(1950), 29.1, 0.1);
  EXPECT_NEAR(deltaTSeconds(2000), 63.9, 0.1);
  EXPECT_NEAR(deltaTSeconds(2100), 203, 1);
  for (const double year : {1920, 1941, 1961, 1986, 2005, 2050}) {
    EXPECT_NEAR(deltaTSeconds(year - 1e-6), deltaTSeconds(year), 0.6) << year;
  }
}

TEST(Refraction, LiftsTheHorizonByHalfADegree) {
  EXPECT_NEAR(refractionDegrees(-0.5667, 1010, 10), 0.5667, 0.02);
  EXPECT_NEAR(refractionDegrees(45, 1010, 10), 0.0168, 0.001);
  EXPECT_NEAR(refractionDegrees(90, 1010, 10), 0, 1e-3);
  EXPECT_EQ(refractionDegrees(10, 0, 10), 0);
}

} // namespace
} // namespace gnomon
