#pragma once

#include "renderer/bake/baked_light.h"
#include "renderer/techniques/picture_points.h"
#include "renderer/techniques/traced_shadow.h"

namespace gnomon {

/// Looks up what each sample of the picture sees of a baked light. Lit where nothing shows. What is turned away from
/// the light has the share of the surface's other side, and is dark.
TracedShadow bakedShadow(const PicturePoints& points, const BakedLight& baked);

} // namespace gnomon
