#pragma once

#include "renderer/bake/baked_light.h"
#include "renderer/core/unfilled.h"
#include "renderer/techniques/picture_points.h"

namespace gnomon {

/// Looks up what each sample of the picture sees of a baked light: a share, 0..65535, in the grid's order. Lit where
/// nothing shows. What is turned away from the light has the share of the surface's other side, and is dark.
UnfilledVector<std::uint16_t> bakedShadow(const PicturePoints& points, const BakedLight& baked);

} // namespace gnomon
