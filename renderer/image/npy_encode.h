#pragma once

#include "protocol/base/result.h"
#include "renderer/image/image.h"

namespace gnomon {

/// What the floats of an image are in an array.
enum class ArrayNumbers {
  float32,
  int32 ///< whole numbers
};

/// An array for NumPy (NPY format 1.0), C order: rows, columns and, of several channels, those; uint8 of an 8-bit
/// image, `numbers` of floats, little endian. Where floats have an alpha channel, color is multiplied by it, as in an
/// EXR.
Result<Bytes> encodeNpy(const Image& image, ArrayNumbers numbers);

} // namespace gnomon
