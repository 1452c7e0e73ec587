#pragma once

#include "renderer/cpu/cast_tiles.h"
#include "renderer/device/device.h"

namespace gnomon::cpu {

/// View `atlas` or `tile`, as `request` asks: the depths of all tiles, or of the input's. REQUIRES: all of their texels
/// are made.
Image atlasPicture(const ShowInput& input, const ViewRequest& request, const CastTiles& cast);

} // namespace gnomon::cpu
