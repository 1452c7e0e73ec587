#pragma once

#include <span>
#include <vector>

#include "renderer/cpu/raster/texel_marks.h"
#include "renderer/cpu/shadow/shadow_maps.h"
#include "renderer/device/device.h"

namespace gnomon::cpu {

/// The share of a light that each point gets by the light's tiles, 0..1: FrameDrawing::probe. On all cores.
std::vector<float> probedShares(const ShadowMaps& maps, const shared::FrameData& frame, int light,
                                std::span<const ProbePoint> points);

/// Marks the texels that probedShares reads, and some beside them. `marks`: one a tile of the maps.
void markProbed(const ShadowMaps& maps, const shared::FrameData& frame, int light, std::span<const ProbePoint> points,
                std::span<TexelMarks> marks);

} // namespace gnomon::cpu
