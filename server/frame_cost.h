#pragma once

#include <algorithm>
#include <cstddef>

#include "protocol/frame_spec.h"

namespace gnomon {

/// What holding a shadow against rays takes besides, for each pixel: what they meet, and how far it is from an edge.
inline constexpr std::size_t kReferenceBytes = 96;

inline bool needsReference(View view) {
  return view == View::reference || view == View::error || view == View::edgeDistance;
}

/// What a frame's pictures take in memory between drawing and encoding, at most: four channels a pixel and view, one
/// byte each for PNG and four for EXR.
inline std::size_t frameBytes(const FrameSpec& spec) {
  const std::size_t bytesPerPixel = spec.output.format == ImageFormat::exr ? 16 : 4;
  const auto ofFrame = static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height);
  std::size_t pixels = 0;
  for (const View view : spec.views) {
    const auto side = static_cast<std::size_t>(spec.atlas.size);
    pixels += view == View::atlas || view == View::tile ? side * side : ofFrame;
  }
  const bool traced = std::any_of(spec.views.begin(), spec.views.end(), needsReference);
  return pixels * bytesPerPixel + (traced ? ofFrame * kReferenceBytes : 0);
}

} // namespace gnomon
