#pragma once

#include "protocol/spec/shadow_options.h"

namespace gnomon {

/// Texels below which a tile is mostly border: a smaller one is raised to it, with a note in the plan, and none is
/// halved below it. Wide enough for every kernel and snapping step.
inline constexpr int kSmallestTile = 64;

/// Texels along a side of one tile, a power of two: min(baseSize * f, nextPowerOfTwo(lightSize * f)), f = size times
/// importance: 2 (XLarge), 1, 1/2, 1/4, 1/8 (XSmall) times 1 (high), 1/2, 1/4 (low). `lightSize`: pixels that the light
/// covers (light_coverage.h). 0 where it covers none. Counted in integers: log(x) / log(2) misrounds.
int askedTileSize(ShadowSize size, ShadowImportance importance, int baseSize, int lightSize);

} // namespace gnomon
