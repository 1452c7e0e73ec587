#pragma once

#include "protocol/shadow_options.h"

namespace gnomon {

/// Texels below which a tile is mostly border: a smaller one is raised to it, with a note in the plan, and none is
/// halved below it. Wide enough for every kernel and snapping step.
inline constexpr int kSmallestTile = 64;

/// Texels along a side of one cascade's tile, a power of two:
/// min(baseSize * f, nextPowerOfTwo(max(frameWidth, frameHeight) * f)), f = 2 (XLarge), 1, 1/2, 1/4, 1/8 (XSmall).
/// 0 for a frame without pixels. Counted in integers: log(x) / log(2) misrounds.
int askedTileSize(ShadowSize size, int baseSize, int frameWidth, int frameHeight);

} // namespace gnomon
