#include <array>
#include <cmath>

#include "protocol/json/json_codec.h"
#include "renderer/render.h"
#include "tests/renderer/frame_fixture.h"
#include "tests/support/png_of.h"

namespace gnomon {
namespace {

using testing::floatsOf;
using testing::pngOf;
using testing::renderJson;
using testing::valueAt;

const std::string kBox = R"({"width":160,"height":90,"camera":{"node":"camera"},
    "lights":[{"type":"directional","sun":{"azimuthDegrees":240,"elevationDegrees":35}}]})";

TEST(Render, H5_TheSameRequestGivesTheSameBytesWhateverCameBetween) {
  const ScenePtr box = testing::generatedScene("box_on_plane");
  const Bytes first = pngOf(renderJson(box, kBox));
  renderJson(testing::generatedScene("lights"), R"({"width":33,"height":77,"antialiasing":"none"})");
  EXPECT_EQ(first, pngOf(renderJson(box, kBox)));
  EXPECT_EQ(first, pngOf(renderJson(testing::generatedScene("box_on_plane"), kBox))) << "loaded anew";
}

TEST(Render, TheEffectiveSpecAsksForTheSamePictureAgain) {
  for (const char* name : {"box_on_plane", "lights", "cameras"}) {
    const ScenePtr scene = testing::generatedScene(name);
    for (const char* spec : {R"({"width":96,"height":64})", R"({"width":96,"height":64,"camera":{"node":"camera"}})",
                             R"({"width":64,"height":64,"camera":{"orbit":{"elevationDegrees":90}}})"}) {
      const Frame frame = renderJson(scene, spec);
      const std::string effective = toJson(frame.report.spec).dump();
      const Frame again = renderJson(scene, effective);
      EXPECT_EQ(pngOf(frame), pngOf(again)) << name << ' ' << spec;
      EXPECT_EQ(effective, toJson(again.report.spec).dump());
    }
  }
}

TEST(Render, WhereNothingIsDepthIsInfinite) {
  const Frame frame = renderJson(testing::generatedScene("empty"),
                                 R"({"width":8,"height":8,"views":["depth","color"],"output":{"format":"exr"},
      "background":{"color":[0.25,0.5,1],"alpha":0.5}})");
  EXPECT_TRUE(std::isinf(valueAt(frame, 0.5, 0.5)));
  const auto& color = floatsOf(frame, 1);
  EXPECT_EQ((std::vector<float>{color[0], color[1], color[2], color[3]}), (std::vector<float>{0.25f, 0.5f, 1, 0.5f}));
}

TEST(Render, LambertReflectsTheShareOfTheLightThatItShould) {
  testing::GlbBuilder plane = testing::plane();
  plane.json["materials"] = {
      {{"pbrMetallicRoughness",
        {{"baseColorFactor", {0.5, 0.5, 0.5, 1}}, {"metallicFactor", 0}, {"roughnessFactor", 1}}}}};
  plane.json["meshes"][0]["primitives"][0]["material"] = 0;
  plane.json["nodes"][0]["scale"] = {10, 1, 10};
  const Frame frame = renderJson(testing::sceneOf(plane),
                                 R"({"width":16,"height":16,"camera":{"eye":[0,8,0],"target":[0,0,0],"up":[0,0,-1]},
      "ambient":{"intensity":0},"lights":[{"type":"directional","direction":[1,-1,0],"intensity":3.14159265}],
      "toneMapping":"none","output":{"format":"exr","exrPixelType":"float"}})");
  // Albedo 0.5 * cos 45 of a light of pi lux: 0.354, and a few hundredths of rough dielectric reflection.
  EXPECT_NEAR(valueAt(frame, 0.5, 0.5), 0.5 * std::sqrt(0.5), 0.03);
}

TEST(Render, X14_AColorTemperatureChangesNoLuminance) {
  testing::GlbBuilder plane = testing::plane();
  plane.json["materials"] = {{{"pbrMetallicRoughness", {{"metallicFactor", 0}}}}};
  plane.json["meshes"][0]["primitives"][0]["material"] = 0;
  const ScenePtr scene = testing::sceneOf(plane);
  const auto lit = [&](const Json& color) {
    Json light = {{"type", "directional"}, {"direction", {0, -1, 0}}};
    light.update(color);
    const Json spec = {{"width", 8},
                       {"height", 8},
                       {"camera", {{"eye", {0, 1, 0}}, {"target", {0, 0, 0}}, {"up", {0, 0, -1}}}},
                       {"ambient", {{"intensity", 0}}},
                       {"lights", {light}},
                       {"output", {{"format", "exr"}, {"exrPixelType", "float"}}}};
    const Frame frame = renderJson(scene, spec.dump());
    const auto& pixels = floatsOf(frame);
    return std::array<double, 3>{pixels.at(0), pixels.at(1), pixels.at(2)};
  };
  const auto luminance = [](const std::array<double, 3>& c) { return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]; };
  const auto white = lit({{"color", {1, 1, 1}}});
  EXPECT_EQ(white, lit(Json::object())) << "white unless told otherwise";
  for (const double kelvin : {1000.0, 2000.0, 4000.0, 15000.0}) {
    const auto color = lit({{"temperatureKelvin", kelvin}});
    EXPECT_NEAR(luminance(color) / luminance(white), 1.0, 1e-5) << kelvin;
    EXPECT_EQ(color[0] > color[2], kelvin < 6500) << kelvin;
  }
}

TEST(Render, TheEdgeOfWhatGlowsIsAntialiased) {
  // Two halves of one plane, alike but for what they give off; their edge crosses the picture's columns at a slant.
  testing::GlbBuilder halves = testing::plane();
  auto& json = halves.json;
  const auto black = [](double emission) {
    return Json{{"pbrMetallicRoughness", {{"baseColorFactor", {0, 0, 0, 1}}, {"metallicFactor", 0}}},
                {"emissiveFactor", {emission, emission, emission}}};
  };
  json["materials"] = {black(0), black(1)};
  auto other = json["meshes"][0];
  json["meshes"][1] = other;
  json["meshes"][0]["primitives"][0]["material"] = 0;
  json["meshes"][1]["primitives"][0]["material"] = 1;
  json["nodes"][0]["translation"] = {-1, 0, 0};
  halves.addRoot({{"mesh", 1}, {"translation", {1, 0, 0}}});
  const Frame frame = renderJson(testing::sceneOf(halves),
                                 R"({"width":64,"height":64,"ambient":{"intensity":0},"toneMapping":"none",
      "camera":{"eye":[0,8,0],"target":[0,0,0],"up":[0.1,0,-1],"orthographic":{"height":1,"near":1,"far":20}},
      "lights":[{"type":"directional","direction":[0,-1,0],"intensity":0.0001}],"output":{"format":"exr"}})");
  const auto& color = floatsOf(frame);
  int between = 0;
  for (std::size_t i = 0; i < color.size(); i += 3) between += color[i] > 0.1f && color[i] < 0.9f ? 1 : 0;
  EXPECT_NEAR(color.front(), 0, 0.01);
  EXPECT_NEAR(color.back(), 1, 0.01);
  EXPECT_GE(between, 32) << "about one pixel a row";
}

TEST(Render, EveryStageIsTimed) {
  const Frame frame = renderJson(testing::generatedScene("box_on_plane"), kBox);
  std::vector<std::string> names;
  for (const StageTime& stage : frame.report.stages) {
    names.push_back(stage.stage);
    EXPECT_GE(stage.milliseconds, 0);
  }
  EXPECT_EQ(names, (std::vector<std::string>{"upload", "survey", "plan", "shadow", "shade", "readback"}));
}

} // namespace
} // namespace gnomon
