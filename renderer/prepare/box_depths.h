#pragma once

#include <cstdint>
#include <span>

#include "renderer/core/aabb.h"
#include "renderer/core/camera_view.h"
#include "renderer/shadow/shadow_plan.h"

namespace gnomon {

/// The blocks of a frame of that many pixels, without spans yet.
ReceiverDepths emptyDepths(int width, int height);

/// What a survey may find at most, told from boxes (eye-relative) around all that it could draw: each block spans from
/// the nearest to the farthest point that a box has behind it, between the camera's planes, each end depthSlack
/// farther. `drawn` marks the boxes that count. Whatever is in the boxes, the blocks of its survey show a surface only
/// where these do, and their spans lie within these. Nothing hides anything, so that every block stays open. Pure.
ReceiverDepths boxDepths(const CameraView& view, int width, int height, std::span<const Aabb> boxes,
                         std::span<const std::uint8_t> drawn);

} // namespace gnomon
