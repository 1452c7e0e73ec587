#pragma once

#include <span>
#include <vector>

#include "protocol/report/frame_report.h"
#include "renderer/reference/reference.h"

namespace gnomon {

/// Metrics of shadows `shown` (S, one image a light of the reference, first row on top, full strength) against the
/// truth. Several lights are pooled: their receivers count together.
ErrorMetrics measureErrors(const Reference& truth, std::span<const std::vector<float>> shown);

/// For one light of the reference: pixels from each edge pixel of S to the nearest edge pixel of V on the same side,
/// lit or in shadow (shadow_edges.h); -1 where S has no edge, infinity where V has none anywhere.
std::vector<float> edgeDistances(const Reference& truth, std::size_t light, std::span<const float> shown);

} // namespace gnomon
