#include "server/worker/frame_memory.h"

#include <algorithm>

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
  if (!traitsOf(shadow.technique).baked) {
    return 0;
  }
  const LightMapOptions& options = shadow.lightMap;
  return static_cast<std::size_t>(options.texelsPerMetre ? kLimits.maxLightMapSide : options.size);
}

} // namespace

std::size_t frameBytes(const FrameSpec& spec) {
  constexpr std::size_t kTriangleBytes = 12; ///< a number, and what it stands for
  const std::size_t bytesPerPixel = spec.output.format == ImageFormat::exr ? 16 : 4;
  const auto ofFrame = static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height);
  std::size_t pixels = 0;
  for (const View view : spec.views) {
    const auto side = static_cast<std::size_t>(spec.atlas.size);
    pixels += traitsOf(view).source == ViewSource::atlas ? side * side : ofFrame;
  }
  const bool traced = std::any_of(spec.views.begin(), spec.views.end(), needsReference);
  const bool triangles = std::any_of(spec.views.begin(), spec.views.end(), tellsOfTriangles);
  return pixels * bytesPerPixel + (traced ? ofFrame * kReferenceBytes : 0) + (triangles ? ofFrame * kTriangleBytes : 0);
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
