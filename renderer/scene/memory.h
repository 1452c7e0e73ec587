#pragma once

#include <cstdint>

#include "protocol/report/replies.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// What a scene takes in memory, with the poses that are kept of it. Images count as if all were decoded.
MemorySummary memoryOf(const Scene& scene);

/// All of it.
std::uint64_t bytesIn(const MemorySummary& memory);

} // namespace gnomon
