#pragma once

#include <span>
#include <vector>

#include "protocol/spec/light.h"
#include "renderer/scene/node_switches.h"
#include "renderer/shaders/shared/frame_types.h"
#include "renderer/shadow/shadow_plan.h"

namespace gnomon {

/// How the shader samples the map: GNOMON_FILTER_...
int filterKind(const Filter& filter);

/// The lights as the shader reads them, relative to the eye; `plan` tells which have tiles. `groups`: what each does to
/// the receiver groups; none = every light lights and shadows all. `layered`: lights that visibility layers serve, one
/// a layer.
std::vector<shared::LightData> lightData(std::span<const Light> lights, const ShadowPlan& plan, const glm::dvec3& eye,
                                         std::span<const LitGroups> groups = {}, std::span<const int> layered = {});

/// The plan's tiles, in its order.
std::vector<shared::TileData> tileData(const ShadowPlan& plan);

} // namespace gnomon
