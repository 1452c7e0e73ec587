#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "protocol/base/result.h"
#include "renderer/device/device.h"
#include "renderer/gl/texture.h"
#include "renderer/passes/views/view_pass.h"

namespace gnomon {

struct ExactShadows {
  VisibilityLayers layers;
  std::vector<LayerFacts> lights; ///< one a layer
  gl::Timer timer;                ///< of all
  std::uint64_t triangles = 0;    ///< of shadow volumes
  std::size_t drawCalls = 0;      ///< of the same
  std::size_t countBytes = 0;     ///< of the stencil that they were counted in
};

/// Whether some of the lights ask which triangles show: surfaces have to be numbered (surface_pass.h). `layered`: as in
/// FrameWork.
bool needsTriangles(std::span<const int> layered, std::span<const Light> lights);

/// The visibility of every light of `layered`, of FrameWork's, at each sample of the surfaces; behind them, unless it
/// is empty, a layer of `volumeShares`, what volumes let through to each.
Result<ExactShadows> exactShadows(const PassInputs& inputs, const Shading& shading, const FrameWork& work,
                                  std::span<const int> layered, const Surfaces& surfaces,
                                  std::span<const std::uint16_t> volumeShares = {});

} // namespace gnomon
