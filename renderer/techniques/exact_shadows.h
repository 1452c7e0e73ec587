#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "renderer/passes/views/view_pass.h"
#include "renderer/reference/traced_scene.h"

namespace gnomon {

/// What exact techniques need besides the frame.
struct ExactInputs {
  std::vector<int> lights; ///< those with a layer, in the layers' order: every technique but shadowMap
  std::function<Result<std::shared_ptr<const TracedScene>>()> traced; ///< asked where rays are needed
};

/// Some light asks rays: surfaces have to be numbered (surface_pass.h).
bool needsRays(const ExactInputs& exact, std::span<const Light> lights);

/// One light's layer, and what it took.
struct ExactShadow {
  int light = 0;                               ///< index into the spec's lights
  double milliseconds = 0;                     ///< on the CPU's clock
  std::optional<std::uint64_t> tracedPixels{}; ///< that rays decided; absent where none are asked
};

struct ExactShadows {
  VisibilityLayers layers;
  std::vector<ExactShadow> lights; ///< one a layer
  gl::Timer timer;                 ///< of all
  std::uint64_t triangles = 0;     ///< of shadow volumes
  std::size_t drawCalls = 0;       ///< alike
  std::size_t countBytes = 0;      ///< of the stencil that they were counted in
};

/// The visibility of every light of `exact` at each sample of the surfaces.
Result<ExactShadows> exactShadows(const PassInputs& inputs, const ViewInputs& shading, const ExactInputs& exact,
                                  const Surfaces& surfaces);

} // namespace gnomon
