#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "protocol/spec/traits.h"
#include "renderer/resolve/resolve_frame.h"
#include "renderer/shadow/shadow_plan.h"

namespace gnomon {

/// The lights that cast shadows in a frame, by their index: none that gives off nothing.
std::vector<int> shadowingLights(const ResolvedFrame& frame);

/// How the shadow of a casting light is found.
const TechniqueTraits& techniqueOf(const ResolvedFrame& frame, int light);

/// Of these, the ones whose technique says of every sample what arrives: they have a visibility layer. Those that are
/// baked follow the others.
std::vector<int> layeredLights(const ResolvedFrame& frame);

/// Of the lights that cast shadows, the ones that get a shadow map: those whose technique reads one, and all of them
/// where a view shows tiles.
std::vector<int> mappedLights(const ResolvedFrame& frame);

/// Whether some light's technique needs the edges of the casters' meshes.
bool needsEdges(const ResolvedFrame& frame);

/// The lights whose maps are planned: mappedLights, and those for which technique auto chose rays.
std::vector<int> plannedLights(const ResolvedFrame& frame);

/// The parts of what is seen that a survey reports separately, because a planned light casts shadows on them alone:
/// receiver groups, a bit each. No part twice, and none for lights that cast shadows on all.
std::vector<std::uint32_t> receiverParts(const ResolvedFrame& frame);

/// What a frame's shadow maps are planned from: those of plannedLights. `seen`: what the camera sees, its parts those
/// of receiverParts.
PlanInput planInput(const ResolvedFrame& frame, const SceneView& scene, SeenDepths seen, int maxTextureSize);

/// A frame's shadow maps.
struct FramePlans {
  PlanInput input;      ///< of `drawn`
  ShadowPlan drawn;     ///< of mappedLights
  PlanInput wholeInput; ///< of `whole`
  ShadowPlan whole;     ///< of plannedLights, where those are more; else empty
};
FramePlans framePlans(const ResolvedFrame& frame, const SceneView& scene, SeenDepths seen, int maxTextureSize);

} // namespace gnomon
