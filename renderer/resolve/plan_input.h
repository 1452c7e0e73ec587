#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "protocol/spec/traits.h"
#include "renderer/resolve/resolve_frame.h"
#include "renderer/shadow/shadow_plan.h"

namespace gnomon {

/// The lights that throw shadows in a frame, by their index: none that gives off nothing.
std::vector<int> shadowingLights(const ResolvedFrame& frame);

/// How the shadow of a light is found, which throws one.
const TechniqueTraits& techniqueOf(const ResolvedFrame& frame, int light);

/// Of these, the ones whose technique says of every sample what arrives: they have a visibility layer. Those that are
/// baked stand behind the others.
std::vector<int> layeredLights(const ResolvedFrame& frame);

/// Of the lights that throw shadows, the ones that get a shadow map: those whose technique reads one, and all of them
/// where a view shows tiles.
std::vector<int> mappedLights(const ResolvedFrame& frame);

/// Whether some light's technique needs the edges of the casters' meshes.
bool needsEdges(const ResolvedFrame& frame);

/// The parts of what is seen that a survey tells by themselves, because a light of `mapped` throws shadows on them
/// alone: receiver groups, a bit each. No part twice, and none for lights that throw shadows on all.
std::vector<std::uint32_t> receiverParts(const ResolvedFrame& frame, std::span<const int> mapped);

/// What the shadow maps of a frame are planned from: those of the lights `mapped`. `seen`: what the camera sees, its
/// parts those of receiverParts.
PlanInput planInput(const ResolvedFrame& frame, const SceneView& scene, SeenDepths seen, std::span<const int> mapped,
                    int maxTextureSize);

} // namespace gnomon
