#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/core/aabb.h"
#include "renderer/core/camera_view.h"
#include "renderer/shadow/shadow_plan.h"

namespace gnomon {

/// Which of the boxes (eye-relative) may show in the picture: one byte a box, 0 = surely hidden. `drawn` marks those
/// that the surveyed depths hold; the others are not looked at. A box is hidden where every block of pixels that it may
/// touch shows nothing, or only surfaces nearer than the box. Never hides what is seen. Pure.
std::vector<std::uint8_t> visibleBoxes(const CameraView& view, const ReceiverDepths& depths,
                                       std::span<const Aabb> boxes, std::span<const std::uint8_t> drawn);

/// The same for boxes that the depths do not hold yet: `wanted` marks them. A box is hidden where every block of pixels
/// that it may touch is covered by surfaces nearer than the box.
std::vector<std::uint8_t> unhiddenBoxes(const CameraView& view, const ReceiverDepths& depths,
                                        std::span<const Aabb> boxes, std::span<const std::uint8_t> wanted);

} // namespace gnomon
