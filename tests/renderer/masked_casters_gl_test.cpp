// Materials whose holes are finer than the texels of a shadow map, or than pixels, seen in rendered frames.
#include <algorithm>
#include <numeric>
#include <random>

#include "protocol/json/json_codec.h"
#include "renderer/image/png_encode.h"
#include "tests/renderer/frame_fixture.h"

namespace gnomon {
namespace {

using testing::floatsOf;
using testing::renderJson;

constexpr int kTexels = 1024; ///< of the texture, a side

/// Texels that let all through or nothing, by chance; so many tenths of them nothing.
Bytes speckles(unsigned opaqueTenths) {
  Image image{kTexels, kTexels, {"R", "G", "B", "A"}, std::vector<std::uint8_t>(4 * kTexels * kTexels, 255)};
  auto& pixels = std::get<std::vector<std::uint8_t>>(image.pixels);
  std::mt19937 random(1);
  for (std::size_t i = 3; i < pixels.size(); i += 4) pixels[i] = random() % 10 < opaqueTenths ? 255 : 0;
  return *encodePng(image, 1);
}

/// A ground of 20 m and a sheet of 10 m at y 2, whose texels are 1 cm; half of that where they are `moved` by a
/// transform.
ScenePtr specklesOver(const std::string& alphaMode, bool moved, unsigned opaqueTenths = 3) {
  const Bytes png = speckles(opaqueTenths);
  testing::GlbBuilder builder = testing::plane();
  builder.json["nodes"][0]["scale"] = {10, 1, 10};
  builder.add("images", {{"bufferView", builder.addView(png)}, {"mimeType", "image/png"}});
  builder.add("textures", {{"source", 0}});
  Json texture = {{"index", 0}};
  if (moved) {
    texture["extensions"]["KHR_texture_transform"] = {{"scale", {2, 2}}, {"rotation", 0.5}};
    builder.json["extensionsUsed"] = {"KHR_texture_transform"};
  }
  builder.add("materials", {{"alphaMode", alphaMode}, {"pbrMetallicRoughness", {{"baseColorTexture", texture}}}});
  builder.add("meshes", builder.json["meshes"][0]);
  builder.json["meshes"][1]["primitives"][0]["material"] = 0;
  builder.addRoot({{"mesh", 1}, {"scale", {5, 1, 5}}, {"translation", {0, 2, 0}}});
  return testing::sceneOf(builder);
}

/// The mean share of the light on the ground below the sheet. A tile's texels are about 6 cm.
double meanBelow(const ScenePtr& scene, const Json& light, Json shadow) {
  shadow["size"] = "XSmall";
  shadow["filter"] = {{"type", "pcf"}, {"size", 7}};
  const Json spec = {
      {"width", 96},
      {"height", 96},
      {"camera",
       {{"eye", {0, 1.9, 0}}, {"target", {0, 0, 0}}, {"up", {0, 0, -1}}, {"perspective", {{"fovYDegrees", 120}}}}},
      {"lights", {light}},
      {"shadow", shadow},
      {"antialiasing", "none"},
      {"views", {"shadow"}},
      {"output", {{"format", "exr"}, {"exrPixelType", "float"}}}};
  const Frame frame = renderJson(scene, spec.dump());
  const auto& visibility = floatsOf(frame);
  return std::accumulate(visibility.begin(), visibility.end(), 0.0) / static_cast<double>(visibility.size());
}

const std::vector<Json> kLights = Json::parse(R"([{"type":"directional","direction":[0.02,-1,0.01]},
    {"type":"spot","position":[0.3,9,0.2],"direction":[0,-1,0.01],"outerConeDegrees":40},
    {"type":"point","position":[0.3,9,0.2]}])");

TEST(MaskedCasters, G2_HolesFinerThanAMapsTexelsLetThroughAsMuchAsRaysFind) {
  for (const bool moved : {false, true}) {
    for (const char* mode : {"MASK", "BLEND"}) {
      const ScenePtr scene = specklesOver(mode, moved);
      for (const Json& light : kLights) {
        const Json cut = {{"blendedCasters", "threshold"}};
        Json traced = cut;
        traced["technique"] = "rayTraced";
        const double byRays = meanBelow(scene, light, traced);
        EXPECT_GT(byRays, 0.6);
        EXPECT_LT(byRays, 0.8);
        EXPECT_NEAR(meanBelow(scene, light, cut), byRays, 0.03) << mode << light << (moved ? ", moved" : "");
      }
    }
  }
}

TEST(MaskedCasters, X34_FineHolesThatAreDitheredLetThroughTheMeanOfWhatTheyLeave) {
  for (const bool moved : {false, true}) {
    const ScenePtr scene = specklesOver("BLEND", moved);
    for (const Json& light : kLights) {
      EXPECT_NEAR(meanBelow(scene, light, {{"blendedCasters", "dither"}}), 0.7, 0.03)
          << light << (moved ? ", moved" : "");
    }
  }
}

/// From high above, where a pixel is as large as 8 texels, the eye sees no holes.
TEST(MaskedCasters, G2_WhereTheEyeSeesNoHolesTheShadowIsThatOfWhatItSees) {
  for (const bool moved : {false, true}) {
    const ScenePtr scene = specklesOver("MASK", moved, 8);
    for (Json light : kLights) {
      for (const char* technique : {"rayTraced", "hybrid", "shadowMap"}) {
        light["shadow"] = {{"technique", technique}};
        const Json spec = {{"width", 96},
                           {"height", 96},
                           {"camera", {{"eye", {0, 12, 0}}, {"target", {0, 0, 0}}, {"up", {0, 0, -1}}}},
                           {"lights", {light}},
                           {"antialiasing", "none"},
                           {"views", {"shadow", "reference"}},
                           {"output", {{"format", "exr"}, {"exrPixelType", "float"}}}};
        const Frame frame = renderJson(scene, spec.dump());
        for (std::size_t view = 0; view < 2; ++view) {
          const auto& lit = std::get<std::vector<float>>(frame.images[view].image.pixels);
          EXPECT_GT(std::ranges::min(lit), 0.999f) << technique << light << (moved ? ", moved " : " ") << view;
        }
        ASSERT_TRUE(frame.report.error);
        EXPECT_EQ(frame.report.error->misclassified, 0) << technique << light;
      }
    }
  }
}

} // namespace
} // namespace gnomon
