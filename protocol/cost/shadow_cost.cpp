#include <algorithm>
#include <array>
#include <cmath>

#include "protocol/base/text.h"
#include "protocol/cost/frame_cost.h"
#include "protocol/spec/frame_lights.h"
#include "protocol/spec/traits.h"

namespace gnomon {
namespace {

// Nanoseconds, on two cores, by the CPU device, fitted to the frames of bench_choice: what a picture shows of a scene
// grows far more slowly than the number of its triangles.
constexpr double kTileTriangle = 4;      ///< of the scene, once a tile
constexpr double kTileRow = 470;         ///< of the tiles, were they one square, of a scene of one triangle
constexpr double kTileGrowth = 0.23;     ///< power of the triangles that this grows by
constexpr double kBlurredTexel = 14;     ///< of a tile with moments, of which all are read
constexpr double kTap = 0.16;            ///< of a filter, for each pixel
constexpr double kPoint = 3.9;           ///< of a picture, which may need a ray
constexpr double kRay = 0.87;            ///< of a pixel, through a scene of one triangle
constexpr double kRayGrowth = 0.3;       ///< power of the triangles that this grows by
constexpr double kHoles = 2.75;          ///< more, where all of a scene's triangles have holes
constexpr double kHolesGrowth = 0.35;    ///< power of their share that this grows by
constexpr double kPenumbra = 0.127;      ///< more with 16 rays, times the binary logarithm of the triangles
constexpr double kSampledLookups = 1.28; ///< times as much with samples, at edges
constexpr double kSampledRays = 1.41;
constexpr double kSlowerMaps = 6;    ///< drawn by OpenGL without a GPU
constexpr double kFasterMaps = 0.05; ///< by a GPU

/// Texels that a filter reads for a pixel, about.
double tapsOf(const Filter& filter) {
  constexpr double kDisc = 32;
  if (const int taps = traitsOf(filter.type).taps; taps > 0) return taps;
  return filter.radius ? kDisc : static_cast<double>(filter.size) * filter.size;
}

/// As if the light showed in all of the picture.
double tileSide(const Light& light, const FrameSpec& spec) {
  const Shadow& shadow = *light.shadow;
  return askedTileSize(*shadow.size, shadow.importance, spec.atlas.baseSize, std::max(spec.width, spec.height));
}

/// By DeviceKind.
constexpr std::array kMapFactors{1.0, kSlowerMaps, kFasterMaps};

std::string ratioText(double ratio) {
  return shortNumber(std::round(ratio * 100) / 100);
}

} // namespace

DeviceKind kindOf(const RendererInfo& info) {
  if (info.device == DeviceChoice::cpu) return DeviceKind::processor;
  return info.software ? DeviceKind::softwareGl : DeviceKind::gpu;
}

double pixelsOf(const FrameSpec& spec) {
  return static_cast<double>(spec.width) * spec.height;
}

double tileTexels(const Light& light, const FrameSpec& spec) {
  const double room = static_cast<double>(spec.atlas.size) * spec.atlas.size;
  return std::min(tileCount(light) * tileSide(light, spec) * tileSide(light, spec), room);
}

double tileCost(const Light& light, const FrameSpec& spec, std::uint64_t triangles) {
  const double texels = tileTexels(light, spec);
  const auto count = static_cast<double>(triangles);
  const double rows = std::sqrt(texels * spec.atlas.samples);
  return tileCount(light) * count * kTileTriangle + rows * kTileRow * std::pow(count, kTileGrowth) +
         (traitsOf(light.shadow->filter.type).moments ? texels * kBlurredTexel : 0.0);
}

double lookupOfPixel(const Filter& filter) {
  return tapsOf(filter) * kTap;
}

double rayCost(const Light& light, const FrameSpec& spec, const SceneCounts& scene) {
  const auto triangles = static_cast<double>(scene.triangles);
  double pixel = kPoint + kRay * std::pow(triangles, kRayGrowth);
  if (samplesOf(spec.antialiasing) > 1) pixel *= kSampledRays;
  if (scene.holed > 0) pixel *= 1 + kHoles * std::pow(static_cast<double>(scene.holed) / triangles, kHolesGrowth);
  if (hasSize(light)) {
    pixel *= 1 + kPenumbra * std::log2(1 + triangles) * (light.shadow->raySamples - 1) / 15;
  }
  return pixelsOf(spec) * pixel;
}

TechniqueChoice chooseTechnique(const Light& light, const FrameSpec& spec, const SceneCounts& scene,
                                DeviceKind device) {
  constexpr double kMillisecond = 1e6;
  const double lookups =
      pixelsOf(spec) * lookupOfPixel(light.shadow->filter) * (samplesOf(spec.antialiasing) > 1 ? kSampledLookups : 1.0);
  const double map = kMapFactors[static_cast<std::size_t>(device)] * (tileCost(light, spec, scene.triangles) + lookups);
  const double rays = rayCost(light, spec, scene);
  TechniqueChoice choice{ShadowTechnique::rayTraced, {}, map / kMillisecond, rays / kMillisecond};
  const double ratio = rays / map;
  if (light.shadow->filter != Filter{} || light.shadow->bias != Bias{}) {
    choice.technique = ShadowTechnique::shadowMap;
    choice.why = "The request sets a filter or a bias, which only maps have.";
  } else if (ratio > kRaysPerMap) {
    choice.technique = ShadowTechnique::shadowMap;
    choice.why = "Rays are estimated to cost " + ratioText(ratio) + " times the map, more than " +
                 ratioText(kRaysPerMap) + " times.";
  } else {
    choice.why = "Rays, which are exact, are estimated to cost " + ratioText(ratio) + " times the map, at most " +
                 ratioText(kRaysPerMap) + " times.";
  }
  return choice;
}

} // namespace gnomon
