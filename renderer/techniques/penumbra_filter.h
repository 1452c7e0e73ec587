#pragma once

#include <span>

#include "renderer/techniques/picture_shares.h"

namespace gnomon {

/// Few rays leave noise in a penumbra, which is another from pixel to pixel, while a wide penumbra is nearly the same:
/// brings each pixel that more rays than the first were sent from as close to the slope of those around it as noise has
/// to do with their differences (share_square.h). `raysOf`: how many rays a pixel has had after each round.
void evenOut(const PicturePoints& points, std::span<const int> raysOf, PictureShares& shares);

} // namespace gnomon
