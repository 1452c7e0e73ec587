#include "protocol/spec/settled_sun.h"

#include <cmath>

#include "protocol/sun/solar_position.h"

namespace gnomon {

Sun settledSun(const Sun& sun) {
  Sun settled;
  if (sun.time) {
    const SolarPosition position = solarPosition(
        *readMoment(*sun.time),
        {.latitudeDegrees = sun.latitudeDegrees.value(), .longitudeDegrees = sun.longitudeDegrees.value()});
    settled.azimuthDegrees = std::fmod(position.azimuthDegrees + sun.northDegrees.value_or(0) + 720, 360);
    settled.elevationDegrees = position.elevationDegrees;
    return settled;
  }
  settled.azimuthDegrees = sun.azimuthDegrees.value_or(kUsualSunAzimuth);
  settled.elevationDegrees = sun.elevationDegrees.value_or(kUsualSunElevation);
  return settled;
}

bool isNight(const Sun& sun) {
  return sun.time && *settledSun(sun).elevationDegrees <= 0;
}

} // namespace gnomon
