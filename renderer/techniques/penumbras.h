#pragma once

#include "renderer/techniques/picture_shares.h"

namespace gnomon {

/// Sends more rays to a light that has a size from where the first one a pixel, which `shares` holds, leaves a doubt:
/// to 4 from every pixel that lies within two of where shares differ, until there is none any more, and from those
/// beside masks, where what shows may be a pixel large; then to four times as many, and so on up to `samples`, from
/// those that differ by as much as an edge or noise would. At last evens out what noise is left. The places on the
/// light that the first rays of 4 x 4 pixels go to fill it evenly, so that a penumbra is missed only where it takes a
/// few hundredths of the light at most.
void tracePenumbras(const PicturePoints& points, const TracedLight& light, int samples, PictureShares& shares);

} // namespace gnomon
