#pragma once

#include "protocol/base/result.h"
#include "renderer/image/image.h"

namespace gnomon {

/// Pixels along a side of a WebP, at most.
inline constexpr int kMaxWebpSide = 16383;

/// A lossy WebP of an 8-bit image of 1, 3 or 4 channels; a fourth is straight alpha, kept exactly. `quality`: 0
/// smallest
/// .. 100 best. A problem of code tooLarge where a side is longer than kMaxWebpSide. Equal images give equal bytes.
Result<Bytes> encodeWebp(const Image& image, int quality);

} // namespace gnomon
