#pragma once

#include <optional>

#include "renderer/core/aabb.h"
#include "renderer/core/camera_view.h"
#include "renderer/shadow/shadow_plan.h"

namespace gnomon {

/// A box on the picture: the blocks that it may touch, and its least view depth.
struct Footprint {
  int firstColumn = 0, lastColumn = -1;
  int firstRow = 0, lastRow = -1;
  double nearest = 0;
};

/// Of an eye-relative box, in the blocks of `depths`. Absent where it reaches in front of the near plane: it may cover
/// anything.
std::optional<Footprint> footprintOf(const CameraView& view, const ReceiverDepths& depths, const Aabb& box);

} // namespace gnomon
