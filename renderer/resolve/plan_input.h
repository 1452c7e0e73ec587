#pragma once

#include <span>

#include "renderer/resolve/hybrid_maps.h"
#include "renderer/shadow/shadow_plan.h"

namespace gnomon {

/// The lights that throw shadows in a frame, by their index.
std::vector<int> shadowingLights(const ResolvedFrame& frame);

/// Of these, the ones whose shadow comes from visibility layers: every technique but shadowMap.
std::vector<int> layeredLights(const ResolvedFrame& frame);

/// True for techniques that draw shadow maps.
inline bool isMapped(ShadowTechnique technique) {
  return technique == ShadowTechnique::shadowMap || technique == ShadowTechnique::hybrid;
}

/// Of the lights that throw shadows, the ones that get a shadow map on this device.
std::vector<int> mappedLights(const ResolvedFrame& frame, const SceneView& scene, const RendererInfo& device,
                              HybridMaps maps);

/// What the shadow maps of a frame are planned from: those of the lights `mapped`. `receivers`: what the camera sees.
PlanInput planInput(const ResolvedFrame& frame, const SceneView& scene, const ReceiverDepths& receivers,
                    std::span<const int> mapped, int maxTextureSize);

} // namespace gnomon
