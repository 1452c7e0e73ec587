#include "renderer/export/export_files.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "protocol/spec/debug_light.h"
#include "renderer/export/baked_glb.h"
#include "renderer/frame/baked_scene.h"
#include "renderer/image/picture_encode.h"
#include "renderer/resolve/studio_radiance.h"
#include "renderer/scene/scene.h"

namespace gnomon {

namespace {

/// What a file is of.
struct Chosen {
  std::vector<int> lights;
  bool environment = false;
};

Result<Chosen> chosenOf(const BakedScene& baked, std::optional<int> light) {
  const bool hasEnvironment = baked.environment.baked != nullptr;
  if (!light) return Chosen{baked.lights, hasEnvironment};
  if (light == kEnvironmentLight && hasEnvironment) return Chosen{{}, true};
  if (std::find(baked.lights.begin(), baked.lights.end(), *light) != baked.lights.end()) return Chosen{{*light}, false};
  std::string known;
  for (const int each : baked.lights) (known += known.empty() ? "" : ", ") += std::to_string(each);
  if (hasEnvironment) (known += known.empty() ? "" : ", ") += kEnvironmentName;
  if (light == kEnvironmentLight) {
    return Problem{ProblemCode::invalidValue, "/light", "The environment was not baked.", known, kEnvironmentName};
  }
  return Problem{ProblemCode::invalidValue, "/light", "This light was not baked.", known, std::to_string(*light)};
}

const BakedLight& bakedOf(const BakedScene& baked, int light) {
  return *baked.found[static_cast<std::size_t>(light)].baked;
}

/// Of one plane or three, texel by texel.
using Planes = std::vector<const LightMap*>;

Planes planesOf(const BakedLight& environment) {
  return {&environment.map, &environment.greenAndBlue[0], &environment.greenAndBlue[1]};
}

std::vector<std::string> channelsOf(const Planes& planes) {
  return planes.size() == 1 ? std::vector<std::string>{"Y"} : std::vector<std::string>{"R", "G", "B"};
}

template <class T, class FromShare>
Image imageOf(const Planes& planes, const FromShare& fromShare) {
  std::vector<T> pixels;
  pixels.reserve(planes.size() * planes.front()->shares.size());
  for (std::size_t i = 0; i < planes.front()->shares.size(); ++i) {
    for (const LightMap* plane : planes) pixels.push_back(fromShare(plane->shares[i]));
  }
  return {planes.front()->width, planes.front()->height, channelsOf(planes), std::move(pixels)};
}

Image bytesOf(const Planes& planes) {
  return imageOf<std::uint8_t>(planes,
                               [](std::uint16_t share) { return static_cast<std::uint8_t>((share + 128) / 257); });
}

Image floatsOf(const Planes& planes) {
  return imageOf<float>(planes, [](std::uint16_t share) { return static_cast<float>(share) / 65535; });
}

Result<Bytes> pngOf(const BakedScene& baked, const Chosen& chosen) {
  constexpr int kPngLevel = 2;
  const Planes planes =
      chosen.lights.empty() ? planesOf(*baked.environment.baked) : Planes{&bakedOf(baked, chosen.lights.front()).map};
  return encodePng(bytesOf(planes), kPngLevel);
}

Result<Bytes> exrOf(const BakedScene& baked, const Chosen& chosen) {
  std::vector<Image> images;
  std::vector<std::string> names;
  for (const int light : chosen.lights) {
    images.push_back(floatsOf({&bakedOf(baked, light).map}));
    names.push_back("light" + std::to_string(light));
  }
  if (chosen.environment) {
    images.push_back(floatsOf(planesOf(*baked.environment.baked)));
    names.emplace_back(kEnvironmentName);
  }
  std::vector<ImageLayer> layers;
  for (std::size_t i = 0; i < images.size(); ++i) layers.push_back({names[i], &images[i]});
  return encodeExr(layers, ExrCompression::zip, ExrPixelType::float_);
}

Result<Bytes> glbOf(const BakedScene& baked, const Chosen& chosen) {
  const FrameSpec& spec = baked.frame.spec;
  std::vector<ShadowedLight> shadowed;
  for (const int light : chosen.lights) {
    shadowed.push_back({(*spec.lights)[static_cast<std::size_t>(light)], bakedOf(baked, light)});
    if (shadowed.back().baked.layout->corners == shadowed.front().baked.layout->corners) continue;
    return Problem{ProblemCode::invalidValue, "/lights/" + std::to_string(light) + "/shadow/lightMap",
                   "A GLB has one map for all lights, but this light was baked more finely or less than another.",
                   "the same size or texelsPerMetre for all lights, or one light"};
  }
  std::optional<ShadowedEnvironment> environment;
  if (chosen.environment)
    environment.emplace(ShadowedEnvironment{baked.around, studioRadiance(spec), *baked.environment.baked});
  const SceneView& view = baked.scene->scenes[static_cast<std::size_t>(baked.frame.scene)];
  const IrradianceMap map =
      irradianceMap(*baked.scene, view, baked.frame.nodes, shadowed, environment ? &*environment : nullptr);
  const LightMapLayout& layout = *(environment ? environment->baked : shadowed.front().baked).layout;
  return bakedGlb(*baked.scene, view, baked.frame.nodes, layout, map, kMostExportedBytes);
}

const std::vector<float>& numbersOf(const Frame& frame) {
  return std::get<std::vector<float>>(frame.images.front().image.pixels);
}

Image imageLike(const Frame& frame, std::vector<std::string> channels) {
  const Image& shown = frame.images.front().image;
  return {shown.width, shown.height, std::move(channels), {}};
}

float sensed(float depth, const SensorRange& range) {
  if (!(depth <= range.max)) return std::numeric_limits<float>::infinity();
  return depth < range.min ? 0.0f : depth;
}

std::uint16_t millimetres(float depth) {
  constexpr float kTooFar = 65535;
  return static_cast<std::uint16_t>(std::min(std::round(depth * 1000.0f), kTooFar));
}

using Rgb = std::array<std::uint8_t, 3>;

std::vector<Rgb> labelColors(const Scene& scene) {
  std::vector<Rgb> colors;
  for (const Material& material : scene.materials) {
    Rgb color{};
    for (int i = 0; i < 3; ++i) {
      color[static_cast<std::size_t>(i)] =
          static_cast<std::uint8_t>(std::lround(std::clamp(material.baseColorFactor[i], 0.0f, 1.0f) * 255.0f));
    }
    colors.push_back(color);
  }
  return colors;
}

} // namespace

Result<Bytes> bakeFile(const BakedScene& baked, BakeFile kind, std::optional<int> light) {
  const auto chosen = chosenOf(baked, light);
  if (!chosen) return chosen.problems();
  switch (kind) {
    case BakeFile::png:
      return pngOf(baked, *chosen);
    case BakeFile::exr:
      return exrOf(baked, *chosen);
    case BakeFile::glb:
      return glbOf(baked, *chosen);
  }
  return Problem{ProblemCode::internal, "", "There is no such file of a bake."};
}

Result<Bytes> depthTiff(const Frame& frame, const SensorRange& range, const GoOn& goOn) {
  return untilStopped(goOn, [&] {
    Image image = imageLike(frame, {"Z"});
    std::vector<float> depths = numbersOf(frame);
    for (float& depth : depths) depth = sensed(depth, range);
    image.pixels = std::move(depths);
    return encodeTiff(image);
  });
}

Result<Bytes> depthPng(const Frame& frame, const SensorRange& range, const GoOn& goOn) {
  return untilStopped(goOn, [&] {
    Image image = imageLike(frame, {"Y"});
    std::vector<std::uint16_t> depths;
    depths.reserve(numbersOf(frame).size());
    for (const float depth : numbersOf(frame)) depths.push_back(millimetres(sensed(depth, range)));
    image.pixels = std::move(depths);
    return encodePng(image, frame.report.spec.output.pngCompression);
  });
}

Result<Bytes> labelPng(const Scene& scene, const Frame& frame, const GoOn& goOn) {
  return untilStopped(goOn, [&] {
    const std::vector<Rgb> colors = labelColors(scene);
    Image image = imageLike(frame, {"R", "G", "B"});
    std::vector<std::uint8_t> pixels;
    pixels.reserve(3 * numbersOf(frame).size());
    for (const float material : numbersOf(frame)) {
      const Rgb color = material < 0 ? Rgb{255, 255, 255} : colors[static_cast<std::size_t>(material)];
      pixels.insert(pixels.end(), color.begin(), color.end());
    }
    image.pixels = std::move(pixels);
    return encodePng(image, frame.report.spec.output.pngCompression);
  });
}

} // namespace gnomon
