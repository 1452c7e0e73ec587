#pragma once

#include <optional>

#include "renderer/environment/environment_map.h"

namespace gnomon {

/// Takes the brightest disc out of a map, where it is a sun: nothing is found, and the map stays as it is, unless
/// - the luminance of the brightest texel is at least 500 times the mean over all directions,
/// - the texels around it that are at least half as bright, and touch, are at most a disc of 6 degrees, and
/// - what is taken lights a surface that faces it at least a quarter as much as the mean of what stays would.
/// A window or a softbox fails the first two, a lamp among many the third.
///
/// Its diameter is that of a disc with the area of those texels, so at least about that of one texel. What is taken:
/// within four of its radii and two texels of it, all that is brighter than the mean of the ring around. The sun's
/// place is the mean direction of that light, and its irradiance is that light: sun and rest have the energy that the
/// map had.
std::optional<FoundSun> takeSun(EnvironmentMap& map);

} // namespace gnomon
