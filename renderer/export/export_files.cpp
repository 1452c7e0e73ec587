#include "renderer/export/export_files.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "renderer/export/baked_glb.h"
#include "renderer/frame/baked_scene.h"
#include "renderer/image/picture_encode.h"
#include "renderer/scene/scene.h"

namespace gnomon {

namespace {

Result<std::vector<int>> chosenLights(const BakedScene& baked, std::optional<int> light) {
  if (!light) return baked.lights;
  if (std::find(baked.lights.begin(), baked.lights.end(), *light) != baked.lights.end()) return std::vector{*light};
  std::string lights;
  for (const int each : baked.lights) (lights += lights.empty() ? "" : ", ") += std::to_string(each);
  return Problem{ProblemCode::invalidValue, "/light", "This light was not baked.", lights, std::to_string(*light)};
}

const BakedLight& bakedOf(const BakedScene& baked, int light) {
  return *baked.found[static_cast<std::size_t>(light)].baked;
}

Image greyOf(const LightMap& map) {
  std::vector<std::uint8_t> pixels(map.shares.size());
  std::transform(map.shares.begin(), map.shares.end(), pixels.begin(),
                 [](std::uint16_t share) { return static_cast<std::uint8_t>((share + 128) / 257); });
  return {map.width, map.height, {"Y"}, std::move(pixels)};
}

Image floatsOf(const LightMap& map) {
  std::vector<float> pixels(map.shares.size());
  std::transform(map.shares.begin(), map.shares.end(), pixels.begin(),
                 [](std::uint16_t share) { return static_cast<float>(share) / 65535; });
  return {map.width, map.height, {"Y"}, std::move(pixels)};
}

Result<Bytes> exrOf(const BakedScene& baked, const std::vector<int>& lights) {
  std::vector<Image> images;
  for (const int light : lights) images.push_back(floatsOf(bakedOf(baked, light).map));
  std::vector<ImageLayer> layers;
  for (std::size_t i = 0; i < lights.size(); ++i) layers.push_back({"light" + std::to_string(lights[i]), &images[i]});
  return encodeExr(layers, ExrCompression::zip, ExrPixelType::float_);
}

Result<Bytes> glbOf(const BakedScene& baked, const std::vector<int>& lights) {
  std::vector<ShadowedLight> shadowed;
  for (const int light : lights) {
    shadowed.push_back({(*baked.frame.spec.lights)[static_cast<std::size_t>(light)], bakedOf(baked, light)});
    if (shadowed.back().baked.layout->corners == shadowed.front().baked.layout->corners) continue;
    return Problem{ProblemCode::invalidValue, "/lights/" + std::to_string(light) + "/shadow/lightMap",
                   "A GLB has one map for all lights, but this light was baked more finely or less than another.",
                   "the same size or texelsPerMetre for all lights, or one light"};
  }
  const SceneView& view = baked.scene->scenes[static_cast<std::size_t>(baked.frame.scene)];
  const IrradianceMap map = irradianceMap(*baked.scene, view, baked.frame.nodes, shadowed);
  return bakedGlb(*baked.scene, view, baked.frame.nodes, *shadowed.front().baked.layout, map, kMostExportedBytes);
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
  constexpr int kPngLevel = 2;
  const auto lights = chosenLights(baked, light);
  if (!lights) return lights.problems();
  switch (kind) {
    case BakeFile::png:
      return encodePng(greyOf(bakedOf(baked, lights->front()).map), kPngLevel);
    case BakeFile::exr:
      return exrOf(baked, *lights);
    case BakeFile::glb:
      return glbOf(baked, *lights);
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
