#pragma once

#include "protocol/base/result.h"
#include "renderer/image/image.h"

namespace gnomon {

/// A TIFF of a float image, 32 bits a channel, in deflated strips, made in memory by all cores: no file is opened.
/// Three channels are RGB whatever their names, others are grey and further numbers; where there is alpha, color is
/// multiplied by it, as in an EXR. Equal images give equal bytes. A problem of code tooLarge from 4 GiB on.
Result<Bytes> encodeTiff(const Image& image);

} // namespace gnomon
