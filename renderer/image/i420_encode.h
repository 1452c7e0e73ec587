#pragma once

#include "protocol/base/result.h"
#include "renderer/image/image.h"

namespace gnomon {

/// An 8-bit sRGB image of 1, 3 or 4 channels as video has it: the planes Y', Cb and Cr of BT.709, one after the other,
/// Y' 16..235 and the others 16..240 around 128, first row on top. Cb and Cr have half the width and height, rounded
/// up, and each of their values is the mean of the two by two pixels that it stands for. A fourth channel is left out.
Result<Bytes> encodeI420(const Image& image);

} // namespace gnomon
