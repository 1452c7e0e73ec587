#pragma once

#include <span>
#include <string>
#include <vector>

#include "protocol/base/result.h"
#include "renderer/image/image_codec.h"

namespace gnomon {

/// One part of an EXR: the layers of one size, side by side.
struct ExrPart {
  std::string name; ///< of its first layer; "main" where that has none
  int width = 0;
  int height = 0;
  std::vector<std::string> channels; ///< full names: "layer.channel"
  std::vector<bool> half;            ///< per channel; otherwise float
  std::vector<float> pixels;         ///< interleaved, first row on top
};

/// Groups layers into parts, in the order in which their sizes first appear. Colour is multiplied by its alpha, since
/// EXR's is associated by convention and ours is straight. Depth (a channel called Z) and indices (id)
/// stay float whatever `pixelType` says: half keeps 11 bits, which is decimetres at a hundred metres.
Result<std::vector<ExrPart>> exrParts(std::span<const ImageLayer> layers, ExrPixelType pixelType);

} // namespace gnomon
