#pragma once

#include <optional>

#include "protocol/spec/environment_options.h"
#include "renderer/environment/environment.h"

namespace gnomon {

/// What a sky's light is multiplied by where a request does not say: the sun at noon is as bright as a light's default
/// intensity.
inline constexpr double kUsualSkyIntensity = 3e-5;

/// The sun of a sky as it shines through the air, in lux as linear sRGB. Absent once its disc has set. Its path has no
/// jump: while the disc sets, what is left of it fades.
std::optional<FoundSun> sunOf(const Sky& sky);

/// A clear sky with the ground below it, and its sun, as seen by a standing person: sky_scattering.h. In cd/m^2 (map)
/// and lux (sun) as linear sRGB; X is east, Y up, Z south. No component is negative: what lies outside of sRGB is paled
/// until it is within. Below the horizon lies even ground of `albedo`, lit by sky and sun. Takes about 50 ms of two
/// cores; the same bits for any number of threads.
Environment skyEnvironment(const Sky& sky);

} // namespace gnomon
