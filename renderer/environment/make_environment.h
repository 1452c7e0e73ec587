#pragma once

#include <cstddef>

#include "protocol/spec/environment_options.h"
#include "renderer/environment/environment.h"

namespace gnomon {

/// What frames need of a map that was read.
Environment makeEnvironment(EnvironmentMap map, SunExtraction extraction);

/// Memory that it takes.
std::size_t bytesIn(const Environment& environment);

} // namespace gnomon
