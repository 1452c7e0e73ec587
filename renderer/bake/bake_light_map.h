#pragma once

#include <optional>

#include "renderer/bake/light_map.h"
#include "renderer/bake/light_map_layout.h"
#include "renderer/core/stop.h"
#include "renderer/rays/trace.h"

namespace gnomon {

/// Traces light `light` of `rays` from places all over every texel that a surface covers, and keeps their mean; a light
/// with a size gets `samples` rays a texel or a few more. What no surface covers takes on what lies nearest in its
/// chart. The camera of `rays` does not matter. The same for any number of threads. Nothing where `progress` asks to
/// stop.
std::optional<LightMap> bakeLightMap(const TraceInput& rays, int light, const LightMapLayout& layout, int samples,
                                     const Progress& progress);

} // namespace gnomon
