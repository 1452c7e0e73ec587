#pragma once

#include "protocol/report/capabilities.h"
#include "renderer/resolve/resolve_frame.h"

namespace gnomon {

/// When a light of technique hybrid gets a shadow map. Its shadow is the same either way.
enum class HybridMaps {
  whenCheaper, ///< unless rays alone cost less
  always
};

/// Whether light `light` of the frame gets one. On a GPU, and where a view shows the map, it does; where the processor
/// draws, if the map is cheaper than the rays that it spares.
bool drawsHybridMap(const ResolvedFrame& frame, const SceneView& scene, int light, const RendererInfo& device,
                    HybridMaps maps);

} // namespace gnomon
