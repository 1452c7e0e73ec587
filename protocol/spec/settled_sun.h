#pragma once

#include "protocol/spec/scene_options.h"

/// Where a sun stands in the scene's sky, whichever way a request places it. REQUIRES: the spec has passed validate.h.
namespace gnomon {

/// Azimuth and elevation alone, both set. Of a place and a time: as seen at sea level through the air of
/// solar_position.h.
Sun settledSun(const Sun& sun);

/// Whether the sun's centre is below the horizon of its place at its time. A sun by azimuth and elevation shines from
/// wherever it is.
bool isNight(const Sun& sun);

} // namespace gnomon
