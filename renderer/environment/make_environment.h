#pragma once

#include <cstddef>
#include <optional>

#include "renderer/environment/environment.h"

namespace gnomon {

/// What frames need of a map and the sun that was taken out of it.
Environment makeEnvironment(EnvironmentMap map, const std::optional<FoundSun>& sun);

/// Memory that it takes.
std::size_t bytesIn(const Environment& environment);

} // namespace gnomon
