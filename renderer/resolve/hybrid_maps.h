#pragma once

#include "protocol/report/capabilities.h"
#include "renderer/resolve/resolve_frame.h"

namespace gnomon {

/// Whether light `light` of the frame, of technique hybrid, gets a shadow map. Its shadow is the same either way. On a
/// GPU, and where a view shows the map, it does; where the processor draws, if the map is cheaper than the rays that it
/// spares.
bool drawsHybridMap(const ResolvedFrame& frame, const SceneView& scene, int light, const RendererInfo& device);

} // namespace gnomon
