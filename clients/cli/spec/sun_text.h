#pragma once

#include <optional>
#include <string>

#include "protocol/spec/scene_options.h"

/// How suns are written on the command line. What the texts do not say is left out; whether latitudes, times and angles
/// can be is for the checks of a request.
namespace gnomon::cli {

/// "AZIMUTH,ELEVATION" or "LATITUDE,LONGITUDE TIME"; nothing for any other text.
std::optional<Sun> sunOf(const std::string& text);

/// "LATITUDE,LONGITUDE DATE", the whole day, or "LATITUDE,LONGITUDE BEGIN/END", each a date or a time with its zone;
/// nothing for any other text. A date is its first midnight, by the clock of the place's mean sun: 4 minutes a degree
/// of longitude ahead of UTC.
std::optional<SunHours> sunHoursOf(const std::string& text);

} // namespace gnomon::cli
