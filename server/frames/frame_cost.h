#pragma once

#include <algorithm>
#include <cstddef>

#include "protocol/evaluation/evaluation.h"
#include "protocol/spec/frame_spec.h"
#include "protocol/spec/limits.h"

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

/// What an evaluation takes besides: the largest frame of its variants, one reference, and what is known of every
/// light. `sceneLights`: where a spec names none.
inline std::size_t evaluationBytes(const Evaluation& evaluation, std::size_t sceneLights) {
  constexpr std::size_t kLight = 13;            ///< what arrives at a pixel and what is shown there
  constexpr std::size_t kShadowPicture = 4 * 4; ///< read back as four floats
  std::size_t most = 0;
  for (const Variant& variant : evaluation.variants) {
    const std::size_t pixels =
        static_cast<std::size_t>(variant.spec.width) * static_cast<std::size_t>(variant.spec.height);
    const std::size_t lights =
        std::max<std::size_t>(variant.spec.lights ? variant.spec.lights->size() : sceneLights, 1);
    const auto visibility = std::min(pixels * lights * kLight, static_cast<std::size_t>(kLimits.maxVisibilityBytes));
    most = std::max(
        most, std::max(frameBytes(variant.spec), pixels * kShadowPicture) + pixels * kReferenceBytes + visibility);
  }
  return most;
}

} // namespace gnomon
