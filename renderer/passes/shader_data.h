#pragma once

#include <span>
#include <vector>

#include "renderer/gl/buffer.h"
#include "renderer/prepare/lit_light.h"
#include "renderer/resolve/resolve_frame.h"
#include "renderer/shaders/shared/frame_types.h"

namespace gnomon {

/// How the shader reads a map: GNOMON_FILTER_...
int filterKind(const FilterKernel& filter);

/// The lights as the shader reads them.
std::vector<shared::LightData> lightData(std::span<const LitLight> lights);

/// The plan's tiles, in its order.
std::vector<shared::TileData> tileData(const ShadowPlan& plan);

/// The same on the device, with the light lists of the picture's squares.
struct LightBuffers {
  gl::Buffer lights;
  gl::Buffer tiles;
  gl::Buffer lists;
};

LightBuffers uploadLights(std::span<const LitLight> lights, const ShadowPlan& plan,
                          std::span<const std::uint32_t> lists = {});

/// What every shader of a frame reads; the depths of the surfaces are left at 0.
shared::FrameData frameData(const ResolvedFrame& frame);

} // namespace gnomon
