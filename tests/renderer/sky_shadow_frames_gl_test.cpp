// What the scene hides of a uniform sky, in whole frames: closed forms, and casters that let light through.
#include <algorithm>
#include <cmath>
#include <random>

#include "renderer/image/picture_encode.h"
#include "tests/renderer/frame_fixture.h"
#include "tests/renderer/made_environment.h"
#include "tests/renderer/sky_share_frames.h"

namespace gnomon {
namespace {

using testing::floatsOf;
using testing::GlbBuilder;
using testing::meanOf;
using testing::skyShareSpec;

ScenePtr underWhiteSky(const GlbBuilder& builder) {
  SceneBundle bundle = builder.bundle();
  bundle.files["white.hdr"] = testing::hdrFile(16, [](const glm::dvec3&) { return glm::dvec3(1); });
  return testing::sceneOf(bundle);
}

std::vector<float> drawnFloats(const ScenePtr& scene, const Json& spec) {
  return floatsOf(testing::renderJson(scene, spec.dump()));
}

bool allAre(const std::vector<float>& values, float value) {
  return std::all_of(values.begin(), values.end(), [value](float each) { return each == value; });
}

TEST(SkyShadowFrames, AnOpenPlaneGetsTheWholeSkyWithoutNoise) {
  const ScenePtr scene = underWhiteSky(testing::whiteFloor(10));
  Json spec = skyShareSpec(5, 40);
  EXPECT_TRUE(allAre(drawnFloats(scene, spec), 1));
  spec["views"] = {"color"};
  spec.erase("debug");
  const std::vector<float> shaded = drawnFloats(scene, spec);
  spec["environment"]["shadows"] = "none";
  EXPECT_EQ(shaded, drawnFloats(scene, spec));
  // White under radiance 1: the irradiance is pi, which a Lambert surface sends on as radiance 1.
  EXPECT_NEAR(meanOf(shaded), 1, 0.01);
}

TEST(SkyShadowFrames, AWallHidesWhatItsElevationSays) {
  for (const double elevation : {20.0, 45.0, 70.0}) {
    GlbBuilder builder;
    testing::addSquare(builder, 2, 0);
    const auto height = static_cast<float>(std::tan(glm::radians(elevation)));
    testing::addQuad(builder, {{-1000, 0, -1}, {1000, 0, -1}, {1000, height, -1}, {-1000, height, -1}});
    const double lost = (1 - std::cos(glm::radians(elevation))) / 2;
    EXPECT_NEAR(meanOf(drawnFloats(underWhiteSky(builder), skyShareSpec(1, 2))), 1 - lost, 0.005) << elevation;
  }
}

TEST(SkyShadowFrames, ASphereHidesTheSquareOfItsRadiusOverItsHeight) {
  GlbBuilder builder;
  testing::addSquare(builder, 2, 0);
  testing::addSphere(builder, {0, 2, 0}, 1, 96);
  EXPECT_NEAR(meanOf(drawnFloats(underWhiteSky(builder), skyShareSpec(0.9, 2))), 0.75, 0.005);
}

TEST(SkyShadowFrames, NothingArrivesInAClosedBox) {
  GlbBuilder builder = testing::cube();
  testing::addSquare(builder, 0.5f, 0);
  builder.json["materials"] = {{{"doubleSided", true}}};
  builder.json["meshes"][0]["primitives"][0]["material"] = 0;
  EXPECT_TRUE(allAre(drawnFloats(underWhiteSky(builder), skyShareSpec(0.6, 40)), 0));
}

/// Texels that let all through or nothing, by chance; so many tenths of them nothing.
Bytes specklesOf(int opaqueTenths) {
  constexpr int kTexels = 1024;
  Image image{kTexels, kTexels, {"R", "G", "B", "A"}, std::vector<std::uint8_t>(4 * kTexels * kTexels, 255)};
  auto& pixels = std::get<std::vector<std::uint8_t>>(image.pixels);
  std::mt19937 random(1);
  for (std::size_t i = 3; i < pixels.size(); i += 4) {
    pixels[i] = random() % 10 < static_cast<unsigned>(opaqueTenths) ? 255 : 0;
  }
  return *encodePng(image, 1);
}

/// Node 0 is a ground, node 1 a sheet of 100 m that is 2 m above it, of this material, with texels of 10 cm.
GlbBuilder sheetOf(Json material, int opaqueTenths = 0) {
  GlbBuilder builder = testing::plane();
  auto& json = builder.json;
  json["nodes"][0]["scale"] = {10, 1, 10};
  if (opaqueTenths > 0) {
    builder.add("images", {{"bufferView", builder.addView(specklesOf(opaqueTenths))}, {"mimeType", "image/png"}});
    builder.add("textures", {{"source", 0}});
    material["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
  }
  builder.add("materials", material);
  builder.add("meshes", json["meshes"][0]);
  json["meshes"][1]["primitives"][0]["material"] = 0;
  builder.addRoot({{"mesh", 1}, {"scale", {50, 1, 50}}, {"translation", {0, 2, 0}}});
  return builder;
}

Json ofAlpha(const char* mode, double alpha) {
  return {{"alphaMode", mode}, {"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, alpha}}}}};
}

/// Between four texels of which 1 or 3 are opaque, mixed alpha is at least half on 0.153 or 0.847 of the square; of
/// two, on half of it; each texel is opaque with probability 0.3.
constexpr double kPastLeaves = 1 - (0.4116 * 0.1534 + 0.2646 * 0.5 + 0.0756 * 0.8466 + 0.0081);

TEST(SkyShadowFrames, ASheetLetsThroughWhatItsMaterialSays) {
  const Json glass{{"extensions", {{"KHR_materials_transmission", {{"transmissionFactor", 0.8}}}}}};
  struct Sheet {
    const char* name;
    GlbBuilder builder;
    double through;
  };
  for (const Sheet& sheet :
       {Sheet{"opaque", sheetOf(Json::object()), 0}, Sheet{"blend", sheetOf(ofAlpha("BLEND", 0.25)), 0.75},
        Sheet{"masked below the cutoff", sheetOf(ofAlpha("MASK", 0.4)), 1},
        Sheet{"masked above it", sheetOf(ofAlpha("MASK", 0.6)), 0},
        Sheet{"leaves", sheetOf(ofAlpha("MASK", 1), 3), kPastLeaves},
        Sheet{"blended leaves", sheetOf(ofAlpha("BLEND", 0.5), 4), 0.8}, Sheet{"transmissive", sheetOf(glass), 0.8}}) {
    // Past the edges of the sheet comes 0.1 % of the sky.
    const double tolerance = sheet.builder.json.contains("textures") ? 0.02 : 0.01;
    const double mean = meanOf(drawnFloats(underWhiteSky(sheet.builder), skyShareSpec(1.9, 60)));
    EXPECT_NEAR(mean, sheet.through, tolerance) << sheet.name;
  }
}

TEST(SkyShadowFrames, SwitchesOfNodesHold) {
  const ScenePtr scene = underWhiteSky(sheetOf(Json::object()));
  const auto with = [&](const Json& nodes) {
    Json spec = skyShareSpec(1.9, 60);
    spec["nodes"] = nodes;
    return drawnFloats(scene, spec);
  };
  EXPECT_TRUE(allAre(with({{{"node", 1}, {"castShadow", false}}}), 1));
  EXPECT_TRUE(allAre(with({{{"node", 0}, {"receiveShadow", false}}}), 1));
  EXPECT_TRUE(allAre(with({{{"node", 1}, {"visible", false}}}), 1));
  EXPECT_LT(meanOf(with({{{"node", 1}, {"visible", false}, {"castShadow", true}}})), 0.01);
}

} // namespace
} // namespace gnomon
