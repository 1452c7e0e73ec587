#pragma once

#include <span>
#include <vector>

#include "renderer/cpu/frame_scene.h"
#include "renderer/cpu/raster/depth_buffer.h"
#include "renderer/cpu/surface/textures.h"

namespace gnomon::cpu {

/// The largest level of each texture that what is seen in a buffer reads; of those of `wanted` that nothing seen reads,
/// the smallest. On all cores.
std::vector<ReadTexture> readTextures(const FrameScene& scene, const Textures& textures, const DepthBuffer& buffer,
                                      std::span<const TextureImage> wanted);

} // namespace gnomon::cpu
