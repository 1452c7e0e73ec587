#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/core/camera_view.h"
#include "renderer/prepare/lit_light.h"
#include "renderer/shadow/shadow_plan.h"

namespace gnomon {

/// Frames with more lights than this are lit by lists; fewer are all tried at every pixel, which is faster then.
inline constexpr std::size_t kLightsWithoutLists = 4;

/// Pixels along a side of the squares of the picture that have a list of lights each; whole blocks of the survey.
inline constexpr int kLightListSquare = 64;

/// For each square of the picture, row by row from the TOP, where its list begins and ends; then the lists: the lights
/// that may reach a surface in the square, in the order of `lights`. Never leaves one out that does.
std::vector<std::uint32_t> lightLists(const CameraView& view, const ReceiverDepths& receivers,
                                      std::span<const LitLight> lights);

} // namespace gnomon
