#pragma once

#include "protocol/spec/shadow_options.h"
#include "renderer/core/camera_view.h"
#include "renderer/shadow/fit.h"
#include "renderer/shadow/shadow_plan.h"

namespace gnomon {

/// Texels below which a tile is mostly border: a smaller one is raised to it, with a note in the plan, and none is
/// halved below it. Wide enough for every kernel and snapping step.
inline constexpr int kSmallestTile = 64;

/// Texels along a side of one tile, a power of two: min(baseSize * f, nextPowerOfTwo(lightSize * f)), f = size times
/// importance: 2 (XLarge), 1, 1/2, 1/4, 1/8 (XSmall) times 1 (high), 1/2, 1/4 (low). `lightSize`: pixels that the light
/// covers, from lightSize(). 0 where it covers none. Counted in integers: log(x) / log(2) misrounds.
int askedTileSize(ShadowSize size, ShadowImportance importance, int baseSize, int lightSize);

/// The smallest sphere around all that a spot or point light reaches, relative to the eye. REQUIRES: it has a range.
Sphere reachOf(const ShadowCaster& light);

/// How large a light shows in the picture, pixels: the larger side of the frame for a directional light, for one
/// without an end, and where the camera stands within its reach; else the diameter of the circle around the picture of
/// the sphere that it reaches, no more than the larger side; 0 where that is out of view. Rounded up.
int lightSize(const ShadowCaster& light, const CameraView& view, int frameWidth, int frameHeight);

} // namespace gnomon
