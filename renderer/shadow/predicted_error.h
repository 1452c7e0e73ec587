#pragma once

#include <array>
#include <optional>
#include <vector>

#include "protocol/report/frame_report.h"
#include "renderer/core/camera_view.h"
#include "renderer/shadow/shadow_plan.h"

namespace gnomon {

/// The errors that a plan promises; see PredictedError. Absent where no tile is drawn or none of its blocks is seen.
struct PredictedErrors {
  std::vector<std::optional<PredictedError>> tiles;  ///< one a tile of the plan
  std::vector<std::optional<PredictedError>> lights; ///< one a light of the plan
  std::optional<PredictedError> all;
};

/// A block of the survey that shows a surface, by the middle of its pixels: -1..1, y up; the nearest and the farthest
/// surface in it as view depths, and as points there, relative to the eye.
struct SeenBlock {
  glm::dvec2 ndc{0};
  std::array<double, 2> depths{};
  std::array<glm::dvec3, 2> points{};
};

struct SeenBlocks {
  glm::dvec2 pixels{0}; ///< of the frame
  std::vector<SeenBlock> blocks;
};

SeenBlocks seenBlocks(const CameraView& view, const ReceiverDepths& receivers);

/// m, pixels, for each block that a tile serves: the longer diagonal of the picture, to first order, of the texel under
/// the middle of the block, at its nearest surface that lies in the tile. None for a tile that is not drawn.
std::vector<float> texelExtents(const CameraView& view, const SeenBlocks& seen, const ShadowTile& tile);

/// The percentiles by nearest rank; absent for none.
std::optional<PredictedError> errorOf(std::vector<float> extents);

/// `plan`: of the input. Each light's errors are estimated only where it casts shadows.
PredictedErrors predictErrors(const PlanInput& input, const ShadowPlan& plan);

} // namespace gnomon
