#pragma once

#include <cstdint>
#include <vector>

#include "protocol/base/result.h"
#include "renderer/passes/views/surface_pass.h"

namespace gnomon {

/// The numbers (triangle_numbers.h) of what the samples show, pixel by pixel from the LOWEST row; the samples of a
/// pixel lie side by side. REQUIRES: numbered surfaces.
Result<std::vector<std::uint32_t>> shownTriangles(const PassInputs& inputs, const Surfaces& surfaces);

} // namespace gnomon
