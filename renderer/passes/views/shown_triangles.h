#pragma once

#include <cstdint>
#include <vector>

#include "protocol/base/result.h"
#include "renderer/passes/survey/survey_pass.h"
#include "renderer/passes/views/surface_pass.h"

namespace gnomon {

/// The numbers (prepare/draw_list.h) of what the samples show, pixel by pixel from the LOWEST row; the samples of a
/// pixel lie side by side. REQUIRES: numbered surfaces.
Result<std::vector<std::uint32_t>> shownTriangles(const PassInputs& inputs, const Surfaces& surfaces);

/// Where masked or blended triangles lie before what the survey found, or are it, holes and all: 255 there, one a
/// pixel, from the LOWEST row. Where alpha is as good as the cutoff, their holes may differ from those that rays meet.
/// Empty where the view holds none. With several samples a pixel, also those behind. Waits for the device.
Result<std::vector<std::uint8_t>> maskCoverage(const PassInputs& inputs, const Survey& survey);

} // namespace gnomon
