#pragma once

#include "renderer/core/aabb.h"
#include "renderer/core/camera_view.h"
#include "renderer/shadow/light_basis.h"
#include "renderer/shadow/shadow_plan.h"
#include "renderer/shadow/splits.h"

namespace gnomon {

/// The surfaces that the camera sees in a cascade, as a box in light space relative to the eye; empty where it sees
/// none there. Conservative: it holds the whole piece of view behind each survey block, half a pixel wider on every
/// side, between the block's nearest and farthest depth, cut to the cascade, each end depthSlack farther.
Aabb receiverBox(const CameraView& view, const ReceiverDepths& receivers, const LightBasis& basis,
                 const CascadeInterval& cascade);

} // namespace gnomon
