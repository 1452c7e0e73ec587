#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "renderer/core/aabb.h"
#include "renderer/core/camera_view.h"
#include "renderer/shadow/shadow_plan.h"

namespace gnomon {

/// The blocks of a frame of that many pixels, without spans yet.
ReceiverDepths emptyDepths(int width, int height);

/// Upper bound of a survey, from boxes (eye-relative) around all that it could draw: each block spans from the nearest
/// to the farthest point that a box has behind it, between the camera's planes, each end depthSlack farther. `drawn`
/// marks the boxes that count. Nothing hides anything, so that every block stays open. Pure.
ReceiverDepths boxDepths(const CameraView& view, int width, int height, std::span<const Aabb> boxes,
                         std::span<const std::uint8_t> drawn);

/// The view depths at which the picture may show a part of the box (eye-relative), whatever the planes; none where it
/// shows none. REQUIRES: an orthographic view.
std::optional<DepthInterval> possibleDepths(const CameraView& view, const Aabb& box);

/// A box on the picture: the blocks that it may touch, and its least view depth.
struct Footprint {
  int firstColumn = 0, lastColumn = -1;
  int firstRow = 0, lastRow = -1;
  double nearest = 0;
};

/// Of an eye-relative box, in the blocks of `depths`. Absent where it reaches in front of the near plane: it may cover
/// anything.
std::optional<Footprint> footprintOf(const CameraView& view, const ReceiverDepths& depths, const Aabb& box);

/// Which of the boxes (eye-relative) may show in the picture: one byte a box, 0 = surely hidden: every block of pixels
/// that it may touch shows nothing, or only nearer surfaces. `drawn` marks those that the surveyed depths hold. Pure.
std::vector<std::uint8_t> visibleBoxes(const CameraView& view, const ReceiverDepths& depths,
                                       std::span<const Aabb> boxes, std::span<const std::uint8_t> drawn);

/// The same for boxes that the depths do not hold yet: hidden = every block is covered by nearer surfaces.
std::vector<std::uint8_t> unhiddenBoxes(const CameraView& view, const ReceiverDepths& depths,
                                        std::span<const Aabb> boxes, std::span<const std::uint8_t> wanted);

} // namespace gnomon
