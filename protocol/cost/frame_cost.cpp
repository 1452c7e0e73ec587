#include "protocol/cost/frame_cost.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "protocol/spec/debug_light.h"
#include "protocol/spec/frame_lights.h"
#include "protocol/spec/sun_steps.h"
#include "protocol/spec/traits.h"

namespace gnomon {

SceneCounts sceneCounts(const SceneSummary& summary) {
  SceneCounts counts{summary.triangles, {}};
  for (const LightSummary& light : summary.lights) {
    const auto kind = std::ranges::find(kSpellings<LightType>, light.type, &Spelling::name);
    if (kind != kSpellings<LightType>.end()) counts.lights.push_back(static_cast<LightType>(kind->value));
  }
  if (!summary.volumeFiles.empty()) {
    counts.voxels =
        static_cast<double>(summary.memory.volumes) / static_cast<double>(summary.volumeFiles.size() * sizeof(float));
  }
  counts.environmentLight = summary.environmentLight;
  return counts;
}

namespace {

// Nanoseconds each, on two cores, by the CPU device: of shadow maps, rays and pictures measured, of the others
// estimated.
constexpr double kFrame = 1.5e6;        ///< whatever else a frame is
constexpr double kTriangle = 8;         ///< of the scene, seen or not, for the survey
constexpr double kSample = 4;           ///< of a pixel: to find the nearest surface
constexpr double kShadedPixel = 8;      ///< material and surroundings
constexpr double kLitPixel = 4;         ///< for each light
constexpr double kRayOfTexel = 40;      ///< of a light map
constexpr double kVolumeTriangle = 400; ///< of a shadow volume
constexpr double kReferenceRay = 90;
constexpr double kSkyReference = 1024; ///< rays
constexpr double kSkyPixel = 120;      ///< its point and the filter
constexpr double kSkyRay = 4;          ///< times the binary logarithm of the triangles
constexpr double kDimmedRay = 40;      ///< of the surroundings, by each volume
constexpr double kMarchedPixel = 900;  ///< through a volume of 64 voxels along each side
constexpr double kVolumeStep = 16;     ///< of a ray towards a light, in each of the volumes
constexpr double kPredictedPixel = 80;
constexpr double kReadPixel = 3;
constexpr double kPngPixel = 2.5;    ///< by ISA-L
constexpr double kSmallPngPixel = 8; ///< by libdeflate, for each level
constexpr double kFinerPng = 2.7;    ///< times as much with 16 bits

/// Of a pixel of a view.
struct EncodingCost {
  ImageFormat format;
  double pixel;
};

constexpr std::array kEncodingCosts{
    EncodingCost{ImageFormat::png, kPngPixel}, //
    EncodingCost{ImageFormat::exr, 40},        //
    EncodingCost{ImageFormat::npy, 1},         //
    EncodingCost{ImageFormat::npz, 10},        //
    EncodingCost{ImageFormat::tiff, 9},        //
    EncodingCost{ImageFormat::jpeg, 3},        //
    EncodingCost{ImageFormat::webp, 20},
};
static_assert(rowsAreComplete(kEncodingCosts, &EncodingCost::format));

/// Voxels along a side of a volume, as far as more of them make rays longer.
double volumeSide(const SceneCounts& scene) {
  constexpr double kMost = 512; // more voxels are crossed in longer steps
  return std::clamp(std::cbrt(scene.voxels), 1.0, kMost);
}

/// The light in all volumes: from each point of each, towards each light, through all of them.
double volumeLightCost(const FrameSpec& spec, const SceneCounts& scene, std::size_t lights) {
  constexpr double kMostPoints = 64; // along a side of a light map
  constexpr double kStepsOfVoxel = 2;
  const auto volumes = static_cast<double>(spec.volumes.size());
  const double points = std::pow(std::min(volumeSide(scene) + 1, kMostPoints), 3);
  const double steps = kStepsOfVoxel * volumeSide(scene);
  return volumes * points * volumes * steps * static_cast<double>(std::max<std::size_t>(lights, 1)) * kVolumeStep;
}

double bakedTexels(const LightMapOptions& options) {
  const double side = options.texelsPerMetre ? kLimits.maxLightMapSide / 4.0 : options.size;
  return side * side;
}

/// What the visibility layer of `light` costs, where its technique has one.
void addLayer(const Light& light, const FrameSpec& spec, const SceneCounts& scene, FrameCost& cost) {
  const Shadow& shadow = *light.shadow;
  const TechniqueTraits& technique = traitsOf(shadow.technique);
  if (!technique.layered) return;
  const double pixels = pixelsOf(spec);
  if (technique.baked) {
    cost[FramePart::bake] +=
        bakedTexels(shadow.lightMap) * (hasSize(light) ? shadow.lightMap.samples : 16) * kRayOfTexel;
    cost[FramePart::visibility] += pixels * kLitPixel;
  } else if (technique.traced) {
    cost[FramePart::visibility] += rayCost(light, spec, scene);
  } else {
    cost[FramePart::visibility] +=
        static_cast<double>(scene.triangles) * kVolumeTriangle + pixels * samplesOf(spec.antialiasing) * kSample;
  }
}

/// Of a ray to the environment, past surfaces and volumes.
double skyRayCost(const FrameSpec& spec, const SceneCounts& scene) {
  return kSkyRay * std::log2(2 + static_cast<double>(scene.triangles)) +
         kDimmedRay * static_cast<double>(spec.volumes.size());
}

/// The environment's light in all volumes: from each place of each, in many directions.
double volumeSkyCost(const FrameSpec& spec, const SceneCounts& scene) {
  constexpr double kMostPlaces = 32; // along a side
  constexpr double kRaysOfSample = 16, kMostRays = 1024;
  const double places = std::pow(std::min(volumeSide(scene) + 1, kMostPlaces), 3);
  const double rays = std::min(kRaysOfSample * spec.environment.samples, kMostRays);
  return static_cast<double>(spec.volumes.size()) * places * rays * skyRayCost(spec, scene);
}

/// What rays find of what the scene hides of an environment: those of each pixel, and as many again where they
/// disagree.
double skyCost(const FrameSpec& spec, const SceneCounts& scene) {
  const double rays = 2 * spec.environment.samples + 1;
  double pixel = kSkyPixel + rays * skyRayCost(spec, scene);
  if (samplesOf(spec.antialiasing) > 1) pixel *= 1.2;
  return pixelsOf(spec) * pixel;
}

double encodedPixel(const Output& output) {
  if (output.format != ImageFormat::png) return kEncodingCosts[static_cast<std::size_t>(output.format)].pixel;
  const double finer = output.pngBits == 16 ? kFinerPng : 1;
  return finer * (output.pngCompression <= 2 ? kPngPixel : kSmallPngPixel * output.pngCompression);
}

void addView(View view, const FrameSpec& spec, const std::vector<Light>& lights, double lookups, FrameCost& cost) {
  const ViewTraits& traits = traitsOf(view);
  const double pixels = pixelsOf(spec);
  // Pixels at the edges of triangles show several of them.
  const double shaded = pixels * (traits.source == ViewSource::picture && samplesOf(spec.antialiasing) > 1 ? 1.6 : 1.0);
  if (traits.source == ViewSource::picture) {
    cost[FramePart::shade] += shaded * (kShadedPixel + static_cast<double>(lights.size()) * kLitPixel + lookups);
  } else if (traits.source == ViewSource::data) {
    cost[FramePart::shade] += shaded * (kLitPixel + (traits.shadowed ? lookupOfPixel(Filter{}) : 0.0));
  } else if (traits.source == ViewSource::geometry) {
    cost[FramePart::readback] += pixels * kReadPixel * 4;
  } else if (traits.source == ViewSource::atlas) {
    cost[FramePart::shade] += static_cast<double>(spec.atlas.size) * spec.atlas.size * kReadPixel;
  }
  cost[FramePart::readback] += pixels * kReadPixel;
  cost[FramePart::encode] += pixels * encodedPixel(spec.output);
}

/// Rays towards the light that debug views are about: as many as a comparison takes, or as its shadow asks for.
double referenceRays(const FrameSpec& spec, const std::vector<Light>& lights) {
  constexpr int kLeast = 256;
  const auto chosen = static_cast<std::size_t>(debugLightIndex(spec.debug).value_or(0));
  const Light& light = lights[std::min(chosen, lights.size() - 1)];
  return hasSize(light) ? std::max(kLeast, light.shadow->raySamples) : 1;
}

} // namespace

std::vector<Light> settledLights(const FrameSpec& spec, const SceneCounts& scene, DeviceKind device) {
  std::vector<Light> own;
  for (const LightType type : scene.lights) own.push_back({.type = type});
  FrameSpec sourced = spec;
  sourced.environment = withSource(spec.environment, scene.environmentLight);
  std::vector<Light> lights = lightsOf(sourced, own, assumedSun(sourced.environment));
  for (const int index : shadowingLights(lights, spec.shadowLightPolicy)) {
    Light& light = lights[static_cast<std::size_t>(index)];
    ShadowTechnique& technique = light.shadow->technique;
    if (technique == ShadowTechnique::auto_) technique = chooseTechnique(light, spec, scene, device).technique;
  }
  return lights;
}

FrameCost frameCost(const FrameSpec& spec, const SceneCounts& scene, DeviceKind device) {
  const std::vector<Light> lights = settledLights(spec, scene, device);
  const double pixels = pixelsOf(spec);
  const auto shows = [&](auto which) {
    return std::any_of(spec.views.begin(), spec.views.end(), [&](View view) { return which(traitsOf(view)); });
  };
  FrameCost cost;
  cost[FramePart::fixed] = kFrame;
  cost[FramePart::survey] =
      static_cast<double>(scene.triangles) * kTriangle + pixels * samplesOf(spec.antialiasing) * kSample;
  for (const int index : shadowingLights(lights, spec.shadowLightPolicy)) {
    addLayer(lights[static_cast<std::size_t>(index)], spec, scene, cost);
  }
  if (spec.environment.shadows == EnvironmentShadows::rays) cost[FramePart::visibility] += skyCost(spec, scene);
  double lookups = 0;
  for (const int index : mappedLights(lights, spec)) {
    const Light& light = lights[static_cast<std::size_t>(index)];
    cost[FramePart::shadow] += tileCost(light, spec, scene.triangles);
    lookups += lookupOfPixel(light.shadow->filter);
  }
  for (const View view : spec.views) addView(view, spec, lights, lookups, cost);
  if (shows([](const ViewTraits& view) { return view.source == ViewSource::rays; })) {
    const double rays = showsEnvironment(spec.debug) ? kSkyReference
                        : lights.empty()             ? 0
                                                     : 2 + referenceRays(spec, lights);
    cost[FramePart::reference] = pixels * rays * kReferenceRay;
  }
  if (spec.sunHours && shows([](const ViewTraits& view) { return view.view == View::sunHours; })) {
    const double byDay = static_cast<double>(sunStepCount(*spec.sunHours)) / 2;
    cost[FramePart::reference] += pixels * byDay * kReferenceRay;
  }
  if (spec.debug.predictEdges) cost[FramePart::predict] = pixels * kPredictedPixel;
  if (!spec.volumes.empty()) {
    cost[FramePart::volume] = volumeLightCost(spec, scene, lights.size());
    if (spec.environment.shadows == EnvironmentShadows::rays) cost[FramePart::volume] += volumeSkyCost(spec, scene);
    cost[FramePart::shade] +=
        pixels * static_cast<double>(spec.volumes.size()) * kMarchedPixel * volumeSide(scene) / 64;
  }
  return cost;
}

} // namespace gnomon
