#include "server/worker/frame_memory.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "protocol/spec/limits.h"
#include "protocol/spec/traits.h"

namespace gnomon {
namespace {

bool needsReference(View view) {
  return traitsOf(view).source == ViewSource::rays;
}

bool tellsOfTriangles(View view) {
  return traitsOf(view).source == ViewSource::geometry;
}

std::size_t longerSide(const Shadow& shadow) {
  if (!traitsOf(shadow.technique).baked) return 0;
  const LightMapOptions& options = shadow.lightMap;
  return static_cast<std::size_t>(options.texelsPerMetre ? kLimits.maxLightMapSide : options.size);
}

/// What encoding holds beside the pixels.
struct EncodingBytes {
  ImageFormat format;
  std::size_t files; ///< of every view, in its pixels' size: its file
  std::size_t work;  ///< bytes for each pixel of one view, while that is encoded
};

constexpr std::array kEncodingBytes{
    EncodingBytes{ImageFormat::png, 0, 0}, //
    EncodingBytes{ImageFormat::exr, 0, 0},
    EncodingBytes{ImageFormat::npy, 1, 16},  // with alpha, the colors that it has multiplied
    EncodingBytes{ImageFormat::npz, 1, 32},  // and the array that goes into the ZIP
    EncodingBytes{ImageFormat::tiff, 1, 16}, // as an array
    EncodingBytes{ImageFormat::jpeg, 1, 0},
    EncodingBytes{ImageFormat::webp, 1, 16}, // as YUV, and what is found about its blocks
};
static_assert(rowsAreComplete(kEncodingBytes, &EncodingBytes::format));

std::size_t pixelBytes(View view, const Output& output) {
  constexpr std::size_t kChannels = 4;
  switch (pixelTypeOf(view, output)) {
    case PixelType::bytes:
      return kChannels;
    case PixelType::words:
      return kChannels * sizeof(std::uint16_t);
    case PixelType::numbers:
      return kChannels * sizeof(float);
  }
  return kChannels;
}

} // namespace

std::size_t frameBytes(const FrameSpec& spec) {
  constexpr std::size_t kTriangleBytes = 12; ///< a number, and what it stands for
  const EncodingBytes& encoding = kEncodingBytes[static_cast<std::size_t>(spec.output.format)];
  const auto ofFrame = static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height);
  std::size_t bytes = 0;
  std::size_t largest = 0; // of the views, in pixels
  for (const View view : spec.views) {
    const auto side = static_cast<std::size_t>(spec.atlas.size);
    const std::size_t pixels = traitsOf(view).source == ViewSource::atlas ? side * side : ofFrame;
    bytes += pixels * pixelBytes(view, spec.output) * (1 + encoding.files);
    largest = std::max(largest, pixels);
  }
  bytes += largest * encoding.work;
  const bool traced = std::any_of(spec.views.begin(), spec.views.end(), needsReference);
  const bool triangles = std::any_of(spec.views.begin(), spec.views.end(), tellsOfTriangles);
  return bytes + (traced ? ofFrame * kReferenceBytes : 0) + (triangles ? ofFrame * kTriangleBytes : 0);
}

std::size_t evaluationBytes(const Evaluation& evaluation, std::size_t sceneLights) {
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

std::size_t bakeBytes(const FrameSpec& spec) {
  constexpr std::size_t kTexel = 6; ///< its share while it is found, and in the map
  std::size_t side = longerSide(spec.shadow);
  if (spec.lights) {
    for (const Light& light : *spec.lights) {
      side = std::max(side, light.shadow ? longerSide(*light.shadow) : 0);
    }
  }
  return side * side * kTexel;
}

} // namespace gnomon
