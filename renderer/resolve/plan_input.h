#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "protocol/cost/frame_cost.h"
#include "protocol/spec/traits.h"
#include "renderer/resolve/resolve_frame.h"
#include "renderer/shadow/shadow_plan.h"

namespace gnomon {

/// The lights that cast shadows in a frame, by their index: none that gives off nothing.
std::vector<int> shadowingLights(const ResolvedFrame& frame);

/// How the shadow of a casting light is found.
const TechniqueTraits& techniqueOf(const ResolvedFrame& frame, int light);

/// Of these, the ones whose technique has a visibility layer. Those that are baked follow the others.
std::vector<int> layeredLights(const ResolvedFrame& frame);

/// Of the layered lights, those whose technique looks shadows up in a light map.
std::vector<int> lightsToBake(const ResolvedFrame& frame);

/// Of the lights that cast shadows, the ones that get a shadow map: those whose technique reads one, and all of them
/// where a view shows tiles.
std::vector<int> mappedLights(const ResolvedFrame& frame);

/// Whether some light's technique needs the edges of the casters' meshes.
bool needsEdges(const ResolvedFrame& frame);

/// The parts of what is seen that a survey reports separately, because a planned light casts shadows on them alone:
/// receiver groups, a bit each. No part twice, and none for lights that cast shadows on all.
std::vector<std::uint32_t> receiverParts(const ResolvedFrame& frame);

/// A frame's shadow maps.
struct FramePlans {
  PlanInput input;      ///< of `drawn`
  ShadowPlan drawn;     ///< of mappedLights
  PlanInput wholeInput; ///< of `whole`
  ShadowPlan whole;     ///< also of lights for which technique auto chose rays, where there are such; else empty
};

/// `seen`: what the camera sees, its parts those of receiverParts.
FramePlans framePlans(const ResolvedFrame& frame, const SceneView& scene, SeenDepths seen, int maxTextureSize);

/// What estimates of shadows know of a scene; its lights are left out.
SceneCounts shadowCounts(const Scene& scene, const SceneView& view);

/// Settles technique auto of every light that casts a shadow, by chooseTechnique, and keeps what was chosen in
/// `frame.choices`. `layers`: lights whose visibility a frame may keep; beyond them lights get maps. REQUIRES: the
/// frame has its scene.
void chooseTechniques(const Scene& scene, DeviceKind device, std::size_t layers, ResolvedFrame& frame);

} // namespace gnomon
