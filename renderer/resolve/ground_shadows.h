#pragma once

#include <optional>
#include <span>

#include "protocol/spec/frame_spec.h"
#include "renderer/core/aabb.h"
#include "renderer/scene/node_switches.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// A box around all shadows of a frame's lights on a horizontal plane at `height`; as seen from above, it holds
/// penumbras. Empty = there are none. Nothing = they may lie anywhere: the light is low or among what casts, the
/// surroundings cast shadows or may have a sun, or a volume casts. `view`: without a ground.
std::optional<Aabb> shadowsOnGround(const FrameSpec& spec, const SceneView& view, std::span<const NodeSwitches> nodes,
                                    double height);

} // namespace gnomon
