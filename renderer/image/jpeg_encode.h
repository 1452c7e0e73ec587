#pragma once

#include "protocol/base/result.h"
#include "renderer/image/image.h"

namespace gnomon {

/// A JPEG of an 8-bit image: one channel grey, three RGB; a fourth is left out. `quality`: 1 smallest .. 100 best.
/// Color is as fine as brightness (4:4:4), so that pictures of numbers do not smear. Equal images give equal bytes.
Result<Bytes> encodeJpeg(const Image& image, int quality);

} // namespace gnomon
