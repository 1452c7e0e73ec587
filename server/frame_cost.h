#pragma once

#include <cstddef>

#include "protocol/frame_spec.h"

namespace gnomon {

/// What a frame's pictures take in memory between drawing and encoding, at most: four channels a pixel and view, one
/// byte each for PNG and four for EXR.
inline std::size_t frameBytes(const FrameSpec& spec) {
  const std::size_t bytesPerPixel = spec.output.format == ImageFormat::exr ? 16 : 4;
  std::size_t pixels = 0;
  for (const View view : spec.views) {
    const auto side = static_cast<std::size_t>(spec.atlas.size);
    pixels += view == View::atlas || view == View::tile
                  ? side * side
                  : static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height);
  }
  return pixels * bytesPerPixel;
}

} // namespace gnomon
