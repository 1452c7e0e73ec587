#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/core/camera_view.h"
#include "renderer/shaders/shared/frame_types.h"
#include "renderer/shadow/shadow_plan.h"

namespace gnomon {

/// Frames with more lights than this are lit by lists; fewer are all tried at every pixel, which is faster then.
inline constexpr std::size_t kLightsWithoutLists = 4;

/// For each square of GNOMON_REGION_SIZE pixels, row by row from the TOP of the picture, where its list begins and
/// ends; then the lists: the lights that may reach a surface in the square, in the order of `lights`. Never leaves one
/// out that does. `lights` as lightData gives them. Pure.
std::vector<std::uint32_t> lightLists(const CameraView& view, const ReceiverDepths& receivers,
                                      std::span<const shared::LightData> lights);

} // namespace gnomon
