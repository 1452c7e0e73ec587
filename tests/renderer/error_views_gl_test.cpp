// Shadows held against rays: the numbers in the report, and the pictures of them.
#include <cmath>
#include <gmock/gmock.h>

#include "protocol/json/json_codec.h"
#include "renderer/shaders/shared/functions.h"
#include "tests/renderer/frame_fixture.h"

namespace gnomon {
namespace {

using testing::floatsOf;
using testing::generatedScene;
using testing::renderJson;

const Json kSun = {{"type", "directional"}, {"sun", {{"azimuthDegrees", 120}, {"elevationDegrees", 40}}}};

/// Hard maps, 320 x 180.
Json specOf(const std::vector<std::string>& views, const std::string& format = "exr") {
  return {{"width", 320},
          {"height", 180},
          {"camera", {{"node", "camera"}}},
          {"lights", {kSun}},
          {"shadow", {{"filter", {{"type", "hard"}}}}},
          {"views", views},
          {"output", {{"format", format}, {"exrPixelType", "float"}}}};
}

ErrorMetrics errorsOf(const std::string& scene, const Json& spec) {
  const Frame frame = renderJson(generatedScene(scene), spec.dump());
  EXPECT_TRUE(frame.report.error);
  return frame.report.error.value_or(ErrorMetrics{});
}

const std::vector<std::uint8_t>& bytesOf(const Frame& frame, std::size_t view = 0) {
  return std::get<std::vector<std::uint8_t>>(frame.images.at(view).image.pixels);
}

TEST(ErrorViews, H1_SmallerTilesAreWrongMoreOften) {
  for (const char* scene : {"box_on_plane", "city"}) {
    double before = 1;
    for (const char* size : {"XSmall", "Medium", "XLarge"}) {
      Json spec = specOf({"error"});
      spec["shadow"]["size"] = size;
      const double share = errorsOf(scene, spec).misclassified;
      EXPECT_LT(share, 0.8 * before) << scene << ' ' << size;
      before = share;
    }
  }
}

TEST(ErrorViews, H1_WithoutABiasASurfaceShadowsItself) {
  Json spec = specOf({"error"});
  spec["shadow"]["bias"] = {{"mode", "manual"}, {"depth", 0}, {"slope", 0}, {"normalOffsetScale", 0}};
  const ErrorMetrics errors = errorsOf("box_on_plane", spec);
  EXPECT_GT(errors.acne, 0.01);
  EXPECT_GT(errors.falseShadow, errors.falseLit);
}

TEST(ErrorViews, H1_TooLargeABiasLeaksLight) {
  Json spec = specOf({"error"});
  spec["shadow"]["bias"] = {{"mode", "manual"}, {"depth", 4}}; // more than the box is thick
  const ErrorMetrics errors = errorsOf("box_on_plane", spec);
  EXPECT_GT(errors.leak, 1e-3);
  EXPECT_GT(errors.falseLit, 10 * errors.falseShadow);
  EXPECT_EQ(errors.acne, 0.0);
}

TEST(ErrorViews, H9_RedIsFalseShadowAndBlueFalseLight) {
  for (const double depth : {0.0, 0.2}) {
    Json spec = specOf({"error"}, "png");
    spec["shadow"]["bias"] = {{"mode", "manual"}, {"depth", depth}};
    const Frame frame = renderJson(generatedScene("box_on_plane"), spec.dump());
    ASSERT_EQ(frame.images[0].image.channels, (std::vector<std::string>{"R", "G", "B"}));
    double red = 0;
    double blue = 0;
    const auto& pixels = bytesOf(frame);
    for (std::size_t i = 0; i < pixels.size(); i += 3) {
      if (pixels[i] == pixels[i + 1] && pixels[i] == pixels[i + 2]) continue; // the scene, in grey
      ++(pixels[i] > pixels[i + 2] ? red : blue);
    }
    const ErrorMetrics& errors = *frame.report.error;
    const auto receivers = static_cast<double>(errors.receivers);
    EXPECT_NEAR(red, errors.falseShadow * receivers, 1e-6);
    EXPECT_NEAR(blue, errors.falseLit * receivers, 1e-6);
    EXPECT_GT(red + blue, 0);
  }
}

TEST(ErrorViews, H9_TheErrorIsShadowLessReference) {
  Json spec = specOf({"shadow", "reference", "error"});
  spec["shadow"] = {{"filter", {{"type", "pcf"}, {"size", 5}}}};
  spec["lights"][0]["angularDiameterDegrees"] = 10;
  spec["antialiasing"] = "none";
  const Frame frame = renderJson(generatedScene("box_on_plane"), spec.dump());
  const auto& shown = floatsOf(frame, 0);
  const auto& truth = floatsOf(frame, 1);
  const auto& error = floatsOf(frame, 2);
  int between = 0;
  double sum = 0;
  for (std::size_t i = 0; i < error.size(); ++i) {
    ASSERT_TRUE(error[i] == shown[i] - truth[i] || error[i] == 0.0f) << i;
    between += truth[i] > 0.01f && truth[i] < 0.99f;
    sum += std::abs(error[i]);
  }
  EXPECT_GT(between, 100) << "the light has a size, and so there is a penumbra";
  const ErrorMetrics& errors = *frame.report.error;
  EXPECT_NEAR(sum, errors.meanAbsolute * static_cast<double>(errors.receivers), 1e-3 * sum);
}

TEST(ErrorViews, H9_EdgeDistancesAreThoseOfTheReport) {
  Json spec = specOf({"edgeDistance"});
  spec["shadow"]["size"] = "XSmall";
  const Frame frame = renderJson(generatedScene("box_on_plane"), spec.dump());
  std::vector<float> distances;
  for (const float distance : floatsOf(frame)) {
    if (distance >= 0) distances.push_back(distance);
    if (distance < 0) {
      ASSERT_EQ(distance, -1.0f);
    }
  }
  ASSERT_GT(distances.size(), 100u);
  std::sort(distances.begin(), distances.end());
  EXPECT_EQ(frame.report.error->edgeDisplacement->median, distances[(distances.size() + 1) / 2 - 1]);
  EXPECT_EQ(frame.report.error->edgeDisplacement->max, distances.back());
}

TEST(ErrorViews, H9_EdgesAreColoredByTheirDistance) {
  Json numbers = specOf({"edgeDistance"});
  numbers["shadow"]["size"] = "XSmall";
  Json picture = numbers;
  picture["output"]["format"] = "png";
  const Frame distances = renderJson(generatedScene("box_on_plane"), numbers.dump());
  const Frame colors = renderJson(generatedScene("box_on_plane"), picture.dump());
  const auto& pixels = bytesOf(colors);
  for (std::size_t i = 0; i < floatsOf(distances).size(); ++i) {
    const float distance = floatsOf(distances)[i];
    if (distance < 0) {
      ASSERT_TRUE(pixels[3 * i] == pixels[3 * i + 1] && pixels[3 * i] == pixels[3 * i + 2]) << "grey off the edges";
      continue;
    }
    const glm::vec3 color = shared::heat(distance / 16) * 255.0f;
    for (int c = 0; c < 3; ++c) ASSERT_NEAR(pixels[3 * i + static_cast<std::size_t>(c)], color[c], 0.51f);
  }
}

TEST(ErrorViews, M10_AFaintShadowIsMeasuredAtFullStrength) {
  Json spec = specOf({"error"});
  const ErrorMetrics full = errorsOf("box_on_plane", spec);
  spec["shadow"]["strength"] = 0.3;
  const ErrorMetrics faint = errorsOf("box_on_plane", spec);
  EXPECT_EQ(faint.misclassified, full.misclassified);
  EXPECT_EQ(faint.rms, full.rms);
  EXPECT_LT(faint.misclassified, 0.01);
}

TEST(ErrorViews, H1_LightsOfEveryKindAreMeasured) {
  Json spec = specOf({"error", "reference"});
  spec["lights"] = {kSun,
                    {{"type", "spot"}, {"position", {3, 5, 2}}, {"direction", {-3, -5, -2}}, {"outerConeDegrees", 35}},
                    {{"type", "point"}, {"position", {-2, 3, 2}}},
                    {{"type", "point"}, {"position", {-2, 3, 2}}, {"range", 6}, {"radius", 0.3}}};
  std::vector<std::uint64_t> receivers;
  for (int light = 0; light < 4; ++light) {
    spec["debug"] = {{"light", light}};
    const ErrorMetrics errors = errorsOf("box_on_plane", spec);
    EXPECT_LT(errors.misclassified, 0.02) << light;
    EXPECT_LT(errors.interior, 2e-3) << light;
    EXPECT_TRUE(errors.edgeDisplacement) << light;
    EXPECT_TRUE(errors.predicted) << light;
    receivers.push_back(errors.receivers);
  }
  EXPECT_LT(receivers[1], receivers[0]) << "outside of its cone nothing receives the spot";
  EXPECT_LT(receivers[3], receivers[2]) << "nor beyond a light's range";
}

TEST(ErrorViews, AntialiasingDoesNotChangeWhatIsMeasured) {
  Json spec = specOf({"error", "reference", "shadow"});
  spec["antialiasing"] = "none";
  const Frame one = renderJson(generatedScene("box_on_plane"), spec.dump());
  spec["antialiasing"] = "msaa4x";
  const Frame four = renderJson(generatedScene("box_on_plane"), spec.dump());
  EXPECT_EQ(floatsOf(one, 1), floatsOf(four, 1));
  for (std::size_t i = 0; i < floatsOf(four, 0).size(); ++i) {
    const float error = floatsOf(four, 0)[i];
    ASSERT_TRUE(error == 0 || error == floatsOf(four, 2)[i] - floatsOf(four, 1)[i]) << "one point a pixel";
  }
  // Four samples see a little more, and so the tiles lie a little differently.
  EXPECT_EQ(one.report.error->receivers, four.report.error->receivers);
  EXPECT_NEAR(one.report.error->misclassified, four.report.error->misclassified, 2e-3);
}

TEST(ErrorViews, ALightThatThrowsNoShadowHasNoError) {
  Json spec = specOf({"reference", "error", "edgeDistance"});
  spec["shadow"]["enabled"] = false;
  const Frame frame = renderJson(generatedScene("box_on_plane"), spec.dump());
  EXPECT_GT(frame.report.error->receivers, 0u);
  EXPECT_EQ(frame.report.error->misclassified, 0.0);
  EXPECT_FALSE(frame.report.error->edgeDisplacement);
  EXPECT_FALSE(frame.report.error->predicted) << "there is no map";
  for (const float distance : floatsOf(frame, 2)) ASSERT_EQ(distance, -1.0f);
}

TEST(ErrorViews, H1_ALightThatGivesNothingHasNoReceivers) {
  for (const Json& dark : {Json{{"intensity", 0}}, Json{{"color", {0, 0, 0}}}}) {
    for (const char* technique : {"shadowMap", "rayTraced"}) {
      Json spec = specOf({"reference", "error", "shadow"});
      spec["lights"][0].update(dark);
      spec["shadow"]["technique"] = technique;
      const Frame frame = renderJson(generatedScene("box_on_plane"), spec.dump());
      EXPECT_EQ(frame.report.error->receivers, 0u) << dark << technique;
      EXPECT_EQ(frame.report.error->misclassified, 0.0) << dark << technique;
      for (const std::size_t view : {0u, 2u}) {
        for (const float lit : floatsOf(frame, view)) ASSERT_EQ(lit, 1.0f) << dark << technique;
      }
    }
  }
}

/// A flat disc whose vertices' normals are those given, the same for all, seen from above in a light from straight
/// above.
ErrorMetrics errorsOfDisc(const glm::vec3& normal, bool unlit) {
  testing::GlbBuilder builder = testing::plane();
  auto& primitive = builder.json["meshes"][0]["primitives"][0];
  primitive["attributes"]["NORMAL"] =
      builder.addPoints(std::vector<std::array<float, 3>>(4, {normal.x, normal.y, normal.z}));
  Json material = Json::object();
  if (unlit) material["extensions"]["KHR_materials_unlit"] = Json::object();
  builder.json["extensionsUsed"] = {"KHR_materials_unlit"};
  primitive["material"] = builder.add("materials", material);
  const Json spec = {{"width", 32},
                     {"height", 32},
                     {"camera", {{"eye", {0, 3, 0}}, {"target", {0, 0, 0}}, {"up", {0, 0, -1}}}},
                     {"lights", {{{"direction", {0, -1, 0}}}}},
                     {"shadow", {{"technique", "rayTraced"}}},
                     {"views", {"error"}},
                     {"output", {{"format", "exr"}}}};
  return *renderJson(testing::sceneOf(builder), spec.dump()).report.error;
}

TEST(ErrorViews, H1_WhatTheNormalOfShadingTurnsFromTheLightOrIsUnlitIsNoReceiver) {
  EXPECT_GT(errorsOfDisc({0, 1, 0}, false).receivers, 400u);
  EXPECT_GT(errorsOfDisc(glm::normalize(glm::vec3(1, 0.1f, 0)), false).receivers, 400u);
  EXPECT_EQ(errorsOfDisc(glm::normalize(glm::vec3(1, -0.1f, 0)), false).receivers, 0u);
  EXPECT_EQ(errorsOfDisc({0, 1, 0}, true).receivers, 0u);
}

TEST(ErrorViews, WithoutLightsOrSurfacesNothingIsWrong) {
  for (const char* format : {"png", "exr"}) {
    Json dark = specOf({"reference", "error", "edgeDistance"}, format);
    dark["lights"] = Json::array();
    EXPECT_EQ(errorsOf("box_on_plane", dark).receivers, 0u);
    Json nothing = specOf({"reference", "error", "edgeDistance"}, format);
    nothing["camera"] = {{"eye", {0, 1, 5}}, {"target", {0, 0, 0}}};
    EXPECT_EQ(errorsOf("empty", nothing).receivers, 0u);
  }
  Json nothing = specOf({"reference", "error", "edgeDistance"});
  nothing["camera"] = {{"eye", {0, 1, 5}}, {"target", {0, 0, 0}}};
  const Frame frame = renderJson(generatedScene("empty"), nothing.dump());
  EXPECT_EQ(floatsOf(frame, 0), std::vector<float>(320 * 180, 1.0f));
  EXPECT_EQ(floatsOf(frame, 1), std::vector<float>(320 * 180, 0.0f));
  EXPECT_EQ(floatsOf(frame, 2), std::vector<float>(320 * 180, -1.0f));
}

TEST(ErrorViews, OnlyFramesThatAskAreTraced) {
  const auto stagesOf = [](const Frame& frame) {
    std::vector<std::string> names;
    for (const StageTime& stage : frame.report.stages) names.push_back(stage.stage);
    return names;
  };
  const Frame plain = renderJson(generatedScene("box_on_plane"), specOf({"color", "shadow"}, "png").dump());
  EXPECT_FALSE(plain.report.error);
  EXPECT_THAT(stagesOf(plain), ::testing::Not(::testing::Contains("reference")));
  const Frame traced = renderJson(generatedScene("box_on_plane"), specOf({"color", "error"}, "png").dump());
  EXPECT_TRUE(traced.report.error);
  EXPECT_THAT(stagesOf(traced), ::testing::Contains("reference"));
  EXPECT_TRUE(traced.report.error->predicted);
  EXPECT_EQ(bytesOf(traced), bytesOf(plain)) << "the color view is as ever";
}

} // namespace
} // namespace gnomon
