#pragma once

#include <vector>

#include "renderer/core/aabb.h"
#include "renderer/core/camera_view.h"
#include "renderer/shadow/light_basis.h"
#include "renderer/shadow/shadow_plan.h"
#include "renderer/shadow/splits.h"

namespace gnomon {

/// The surfaces that the camera sees in a cascade, as small boxes in light space relative to the eye; none where it
/// sees none there. Conservative: together they hold the whole piece of view behind each survey block, half a pixel
/// wider on every side, between the block's nearest and farthest depth, cut to the cascade, each end depthSlack
/// farther. Deep pieces are cut along the depth, so that a box is not much larger than what it holds.
std::vector<Aabb> receiverPieces(const CameraView& view, const ReceiverDepths& receivers, const LightBasis& basis,
                                 const CascadeInterval& cascade);

/// The box around boxes.
Aabb boxAround(const std::vector<Aabb>& boxes);

} // namespace gnomon
