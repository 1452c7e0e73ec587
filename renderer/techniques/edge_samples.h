#pragma once

#include "renderer/techniques/picture_shares.h"

namespace gnomon {

// All send rays from every sample of some pixels, and give the pixels that other shares came of.

/// From where camera rays lead, to a light that has no size. Bit by bit what a reference finds there.
Pixels traceExactly(const PicturePoints& points, const TracedLight& light, const Pixels& pixels, PictureShares& shares);

/// To a light that has a size, whose shares are estimates: from where camera rays lead only if that is another triangle
/// than was drawn. `rays`: of a sample. REQUIRES: tracePenumbras.
Pixels traceDoubtful(const PicturePoints& points, const TracedLight& light, int rays, const Pixels& pixels,
                     PictureShares& shares);

/// The same from the points as they were drawn, without camera rays. The samples of a pixel go to other places of the
/// light.
Pixels traceSamples(const PicturePoints& points, const TracedLight& light, int rays, const Pixels& pixels,
                    PictureShares& shares);

} // namespace gnomon
