#pragma once

#include "renderer/passes/views/view_pass.h"
#include "renderer/reference/trace.h"
#include "renderer/techniques/sample_grid.h"

namespace gnomon {

struct HybridShadow {
  std::vector<std::uint16_t> values; ///< share of the light at every sample, 0..65535, in the grid's order
  std::uint64_t tracedPixels = 0;    ///< that the map left to rays
};

/// The shadow map decides where it is sure (certainty_pass.h); at every sample of every other pixel a ray does.
Result<HybridShadow> hybridShadow(const PassInputs& inputs, const ViewInputs& shading, const Surfaces& surfaces,
                                  const TraceInput& rays, int light, const SampleGrid& grid);

} // namespace gnomon
