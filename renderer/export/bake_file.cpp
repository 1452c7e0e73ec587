#include "renderer/export/bake_file.h"

#include <algorithm>
#include <string>

#include "renderer/export/baked_glb.h"
#include "renderer/frame/baked_scene.h"
#include "renderer/image/image_codec.h"
#include "renderer/image/png_encode.h"

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
                   "the same size or texelsPerMetre for all lights, or one light", ""};
  }
  const SceneView& view = baked.scene->scenes[static_cast<std::size_t>(baked.frame.scene)];
  const IrradianceMap map = irradianceMap(*baked.scene, view, baked.frame.nodes, shadowed);
  return bakedGlb(*baked.scene, view, baked.frame.nodes, *shadowed.front().baked.layout, map, kMostExportedBytes);
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
  return Problem{ProblemCode::internal, "", "There is no such file of a bake.", "", ""};
}

} // namespace gnomon
