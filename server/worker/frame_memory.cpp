#include "server/worker/frame_memory.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "protocol/spec/frame_lights.h"
#include "protocol/spec/limits.h"
#include "protocol/spec/traits.h"

namespace gnomon {
namespace {

constexpr std::size_t kFixed = 20u << 20; ///< of any frame: lists of triangles, textures that it is first to read
constexpr std::size_t kTracedPixel = 6;   ///< what rays are sent for, and where masks lie
constexpr std::size_t kBakedTexel = 6;    ///< its share while it is found, and in the map
constexpr std::size_t kBakedSky = 18;     ///< the same of an environment: red, green and blue

/// What a device holds until the pictures are made, in bytes.
struct DeviceBytes {
  std::size_t sample;      ///< depth and triangle; of OpenGL color, too
  std::size_t layerSample; ///< of a light whose shadow is found for each sample
  std::size_t tileTexel;
  std::size_t momentTexel;
  std::size_t picturePixel; ///< beside the picture: what it is drawn to and read from
};

/// By DeviceKind. A GPU has memory of its own; its driver's is counted as if it had none.
constexpr std::array kDeviceBytes{DeviceBytes{8, 2, 4, 16, 0}, //
                                  DeviceBytes{28, 2, 4, 32, 16}, DeviceBytes{28, 2, 4, 32, 16}};

/// What encoding holds beside the pictures, in their sizes.
struct EncodingBytes {
  ImageFormat format;
  std::size_t files; ///< of every view: its file, and what is made of it on the way
  std::size_t work;  ///< of the largest view, while that is encoded
};

constexpr std::array kEncodingBytes{
    EncodingBytes{ImageFormat::png, 1, 0}, //
    EncodingBytes{ImageFormat::exr, 2, 0}, // all views side by side; of halfs, a file that is copied as it grows
    EncodingBytes{ImageFormat::npy, 1, 1}, // with alpha, the colors that it has multiplied
    EncodingBytes{ImageFormat::npz, 1, 2}, // and the array that goes into the ZIP
    EncodingBytes{ImageFormat::tiff, 1, 1}, EncodingBytes{ImageFormat::jpeg, 1, 0},
    EncodingBytes{ImageFormat::webp, 1, 2}, // as YUV, and what is found about its blocks
};
static_assert(rowsAreComplete(kEncodingBytes, &EncodingBytes::format));

std::size_t pixelBytes(View view, const Output& output) {
  const ViewTraits& traits = traitsOf(view);
  const auto channels = [&](const ChannelNames& names) -> std::size_t {
    if (traits.source == ViewSource::picture) return 4; // with its alpha
    return static_cast<std::size_t>(std::ranges::count_if(names, [](std::string_view name) { return !name.empty(); }));
  };
  switch (pixelTypeOf(view, output)) {
    case PixelType::bytes:
      return channels(traits.png);
    case PixelType::words:
      return channels(traits.png) * sizeof(std::uint16_t);
    case PixelType::numbers:
      return channels(traits.exr) * sizeof(float);
  }
  return 0;
}

bool showsAny(const FrameSpec& spec, ViewSource source) {
  return std::any_of(spec.views.begin(), spec.views.end(), [&](View view) { return traitsOf(view).source == source; });
}

/// Pixels of a frame, as if its sides were whole blocks of what is rastered at once.
std::size_t pixelsIn(const FrameSpec& spec) {
  const auto whole = [](int side) { return (static_cast<std::size_t>(side) + 3) / 4 * 4; };
  return whole(spec.width) * whole(spec.height);
}

std::size_t mapSide(const LightMapOptions& options) {
  return static_cast<std::size_t>(options.texelsPerMetre ? kLimits.maxLightMapSide : options.size);
}

/// Of the shadows: tiles of maps, layers of samples, baked maps.
std::size_t shadowBytes(const FrameSpec& spec, std::span<const Light> lights, std::size_t samples,
                        const DeviceBytes& device) {
  std::size_t bytes = 0;
  double texels = 0, moments = 0;
  bool traced = false;
  for (const int index : mappedLights(lights, spec)) {
    const Light& light = lights[static_cast<std::size_t>(index)];
    texels += tileTexels(light, spec);
    if (traitsOf(light.shadow->filter.type).moments) moments += tileTexels(light, spec);
  }
  const double room = static_cast<double>(spec.atlas.size) * spec.atlas.size;
  const auto atTexel = static_cast<std::size_t>(spec.atlas.samples) * device.tileTexel;
  bytes += static_cast<std::size_t>(std::min(texels, room)) * atTexel;
  bytes += static_cast<std::size_t>(std::min(moments, room)) * device.momentTexel;
  for (const int index : shadowingLights(lights, spec.shadowLightPolicy)) {
    const Shadow& shadow = *lights[static_cast<std::size_t>(index)].shadow;
    const TechniqueTraits& technique = traitsOf(shadow.technique);
    if (technique.baked) {
      bytes += mapSide(shadow.lightMap) * mapSide(shadow.lightMap) * kBakedTexel;
    } else if (technique.layered) {
      bytes += samples * device.layerSample;
      traced = technique.traced || traced;
    }
  }
  return bytes + (traced ? pixelsIn(spec) * kTracedPixel : 0);
}

/// Of the volumes: grids, light, and what is marched for each pixel.
std::size_t volumeBytes(const FrameSpec& spec, const SceneSummary& scene, std::size_t lights, std::size_t samples) {
  constexpr std::size_t kPoints = 64 * 64 * 64; ///< of a light map
  constexpr std::size_t kPoint = 16;            ///< in the map
  constexpr std::size_t kPointWork = 32;        ///< while it is made, of one map at a time
  constexpr std::size_t kSample = 4 + 2;        ///< its depth, and its share of the light
  constexpr std::size_t kPixel = 16;            ///< what the volumes send
  const std::size_t volumes = spec.volumes.size();
  if (volumes == 0) return 0;
  const auto most = volumes * static_cast<std::size_t>(kLimits.maxVolumeVoxels);
  const auto voxels = std::min(most, static_cast<std::size_t>(scene.memory.volumes)); // of a byte each
  return voxels * sizeof(float) + volumes * kPoints * kPoint + kPoints * (kPointWork + lights * sizeof(float)) +
         samples * kSample + pixelsIn(spec) * kPixel;
}

/// Of the environment: its map, what is prepared for shading, and what it is prepared from.
std::size_t environmentBytes(const FrameSpec& spec, const SceneSummary& scene) {
  constexpr std::size_t kPrepared = 21u << 20; ///< whatever the map's size
  constexpr std::size_t kSky = 10u << 20;      ///< its map, as cells in which light is summed, too
  constexpr std::size_t kCells = 38u << 20;    ///< of the largest map that is summed, and that map
  constexpr std::size_t kTexel = 3 * sizeof(float);
  constexpr std::size_t kWidth = kLimits.maxEnvironmentWidth;
  const EnvironmentOptions environment = withSource(spec.environment, scene.environmentLight);
  if (environment.sky) return kPrepared + kSky;
  if (isStudio(environment)) return 0;
  const auto map = std::min(static_cast<std::size_t>(scene.memory.environments), kWidth * kWidth / 2 * kTexel);
  return kPrepared + kCells + map;
}

/// Of what the scene hides of it: sums and shares of every pixel, and a share of every sample.
std::size_t skyShadowBytes(const FrameSpec& spec, std::size_t samples) {
  constexpr std::size_t kPixel = 27;
  constexpr std::size_t kSample = 8;
  return spec.environment.shadows == EnvironmentShadows::rays ? pixelsIn(spec) * kPixel + samples * kSample : 0;
}

} // namespace

std::size_t frameBytes(const FrameSpec& spec, const SceneSummary& scene, DeviceKind device, bool asJson) {
  constexpr std::size_t kTriangle = 12;   ///< of a pixel: a number, and what it stands for
  constexpr std::size_t kCaster = 44;     ///< of a pixel: its triangle, what rays hit, and the node that shadows it
  constexpr std::size_t kPredicted = 120; ///< of a pixel: what a map's texel covers there, and edges
  constexpr std::size_t kTextCopies = 6;  ///< base64 is a third longer: as text, in the document, and written
  const DeviceBytes& own = kDeviceBytes[static_cast<std::size_t>(device)];
  const EncodingBytes& encoding = kEncodingBytes[static_cast<std::size_t>(spec.output.format)];
  const std::vector<Light> lights = settledLights(spec, sceneCounts(scene), device);
  const std::size_t pixels = pixelsIn(spec);
  const auto averaged = static_cast<std::size_t>(samplesOf(spec.antialiasing));
  const bool single = averaged > 1 && std::any_of(spec.views.begin(), spec.views.end(), [](View view) {
                        return traitsOf(view).source != ViewSource::picture;
                      });
  const std::size_t samples = pixels * (averaged + (single ? 1 : 0));

  std::size_t pictures = 0, largest = 0;
  for (const View view : spec.views) {
    const auto side = static_cast<std::size_t>(spec.atlas.size);
    const std::size_t shown = traitsOf(view).source == ViewSource::atlas ? side * side : pixels;
    const std::size_t backdrop = traitsOf(view).backdrop ? pixelBytes(View::color, spec.output) : 0;
    const std::size_t bytes = shown * (pixelBytes(view, spec.output) + backdrop);
    pictures += bytes;
    largest = std::max(largest, bytes);
  }
  std::size_t drawn = samples * own.sample + pixels * own.picturePixel + shadowBytes(spec, lights, samples, own) +
                      volumeBytes(spec, scene, lights.size(), samples) + environmentBytes(spec, scene) +
                      skyShadowBytes(spec, samples);
  if (showsAny(spec, ViewSource::rays)) drawn += pixels * kReferenceBytes;
  if (showsAny(spec, ViewSource::geometry)) drawn += pixels * kTriangle;
  if (std::ranges::find(spec.views, View::casterIds) != spec.views.end()) drawn += pixels * kCaster;
  if (spec.debug.predictEdges) drawn += pixels * kPredicted;
  const bool fullExr = spec.output.format == ImageFormat::exr && spec.output.exrPixelType == ExrPixelType::float_;
  const std::size_t files = encoding.files + (fullExr ? 1 : 0) + (asJson ? kTextCopies : 0);
  const std::size_t encoded = samples * own.sample + pictures * files + largest * encoding.work; // samples may be kept
  return kFixed + pictures + std::max(drawn, encoded);
}

std::size_t evaluationBytes(const Evaluation& evaluation, const SceneSummary& scene, DeviceKind device) {
  constexpr std::size_t kLight = 13;            ///< what arrives at a pixel and what is shown there
  constexpr std::size_t kShadowPicture = 4 * 4; ///< read back as four floats
  std::size_t most = 0;
  for (const Variant& variant : evaluation.variants) {
    const std::size_t pixels = pixelsIn(variant.spec);
    const std::size_t lights = settledLights(variant.spec, sceneCounts(scene), device).size();
    const auto visibility = std::min(pixels * std::max<std::size_t>(lights, 1) * kLight,
                                     static_cast<std::size_t>(kLimits.maxVisibilityBytes));
    most = std::max(most,
                    frameBytes(variant.spec, scene, device) + pixels * (kShadowPicture + kReferenceBytes) + visibility);
  }
  return most;
}

std::size_t bakeBytes(const FrameSpec& spec, const SceneSummary& scene) {
  const auto sideOf = [](const Shadow& shadow) {
    return traitsOf(shadow.technique).baked ? mapSide(shadow.lightMap) : 0;
  };
  std::size_t side = sideOf(spec.shadow);
  if (spec.lights) {
    for (const Light& light : *spec.lights) side = std::max(side, light.shadow ? sideOf(*light.shadow) : 0);
  }
  if (spec.environment.shadows == EnvironmentShadows::none) return side * side * kBakedTexel;
  side = std::max(side, mapSide(spec.shadow.lightMap));
  return side * side * (kBakedTexel + kBakedSky) + environmentBytes(spec, scene);
}

} // namespace gnomon
