#pragma once

#include <string>

#include "renderer/image/image.h"

namespace gnomon::testing {

/// How two 8-bit RGBA images differ, in levels of 255 over all their channels.
struct ImageDifference {
  bool sameSize = false;
  int max = 0;
  double mean = 0;
  int worstX = 0; ///< a pixel with the greatest difference
  int worstY = 0;
};

ImageDifference compareImages(const Image& a, const Image& b);

/// Which share of the pixels differs by more than so many levels in a channel. REQUIRES: images of the same size.
double shareBeyond(const Image& a, const Image& b, int levels);

/// Grey where equal, yellow to red where not: eight times the difference.
Image differenceMap(const Image& a, const Image& b);

} // namespace gnomon::testing
