#pragma once

#include "renderer/reference/trace.h"
#include "renderer/techniques/sample_grid.h"

namespace gnomon {

/// Share of a light at every sample of the picture, 0..65535, from rays alone; `hits`: what the rays through the
/// pixels' centres meet, in the grid's order. A pixel is traced at its centre, and where a neighbour sees another
/// share, so that an edge may pass, at each of its samples.
std::vector<std::uint16_t> rayTracedShadow(const TraceInput& input, int light, const SampleGrid& grid,
                                           std::span<const SurfacePoint> hits);

} // namespace gnomon
