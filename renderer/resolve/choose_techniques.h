#pragma once

#include <cstddef>

#include "protocol/cost/shadow_cost.h"
#include "renderer/resolve/resolve_frame.h"

namespace gnomon {

/// What estimates of shadows know of a scene; its lights are left out.
SceneCounts shadowCounts(const Scene& scene, const SceneView& view);

/// Settles technique auto of every light that casts a shadow, by chooseTechnique, and keeps what was chosen in
/// `frame.choices`. `layers`: lights whose visibility a frame may keep; beyond them lights get maps. REQUIRES: the
/// frame has its scene.
void chooseTechniques(const Scene& scene, DeviceKind device, std::size_t layers, ResolvedFrame& frame);

} // namespace gnomon
