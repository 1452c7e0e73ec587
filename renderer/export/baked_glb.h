#pragma once

#include <span>

#include "protocol/base/result.h"
#include "renderer/export/irradiance_map.h"

namespace gnomon {

/// The scene in its pose, as GLB: each placed primitive that is visible with TEXCOORD_1 for the map and in a mesh of
/// its own, materials shared, perspective cameras, no lights, no animations. The map is 8-bit sRGB under MOZ_lightmap,
/// whose intensity gives it the lights' unit again. A problem where a picture of the scene is broken, and tooLarge
/// where the file would have more than `mostBytes`.
Result<Bytes> bakedGlb(const Scene& scene, const SceneView& view, std::span<const NodeSwitches> nodes,
                       const LightMapLayout& layout, const IrradianceMap& map, std::size_t mostBytes);

} // namespace gnomon
