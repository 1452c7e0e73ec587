// Shadows that are baked once and looked up by each frame.
#include <cmath>

#include "tests/renderer/rays/shapes.h"
#include "tests/renderer/scene/animation/animated.h"
#include "tests/renderer/techniques/traced_frame.h"

namespace gnomon {
namespace {

using testing::floatsOf;
using testing::generatedScene;
using testing::misclassified;
using testing::refusedJson;
using testing::renderJson;
using testing::truthOf;

Json specOf(const Json& patch = {}) {
  Json spec{
      {"width", 320},
      {"height", 180},
      {"camera", {{"node", "camera"}}},
      {"lights", {{{"type", "directional"}, {"sun", {{"azimuthDegrees", 120}, {"elevationDegrees", 35}}}}}},
      {"shadow", {{"technique", "lightMap"}, {"lightMap", {{"size", 512}}}}},
      {"antialiasing", "none"},
      {"views", {"shadow"}},
      {"output", {{"format", "exr"}}},
  };
  if (!patch.is_null()) spec.merge_patch(patch);
  return spec;
}

bool reuses(const ScenePtr& scene, const Json& patch) {
  return renderJson(scene, specOf(patch).dump()).report.lights[0].lightMap->reused;
}

TEST(LightMaps, N5_AFrameBakesOnceAndLooksUpFromThenOn) {
  const ScenePtr scene = generatedScene("box_on_plane");
  const Frame first = renderJson(scene, specOf().dump());
  const Frame second = renderJson(scene, specOf().dump());
  ASSERT_TRUE(first.report.lights[0].lightMap && second.report.lights[0].lightMap);
  EXPECT_FALSE(first.report.lights[0].lightMap->reused);
  EXPECT_TRUE(second.report.lights[0].lightMap->reused);
  EXPECT_EQ(floatsOf(first), floatsOf(second));
  EXPECT_FALSE(first.report.lights[0].tracedPixels.has_value());
  EXPECT_LE(first.report.lights[0].lightMap->width, 512);
  EXPECT_EQ(first.report.lights[0].lightMap->madeInstances, scene->scenes[0].instances.size());
  const auto bakes = [](const Frame& frame) {
    return std::count_if(frame.report.stages.begin(), frame.report.stages.end(),
                         [](const StageTime& stage) { return stage.stage == "bake"; });
  };
  EXPECT_EQ(bakes(first), 1);
}

TEST(LightMaps, N5_WhatTheShadowDependsOnMakesAnotherMapAndNothingElseDoes) {
  const ScenePtr scene = generatedScene("box_on_plane");
  EXPECT_FALSE(reuses(scene, {}));
  EXPECT_TRUE(reuses(scene, {{"width", 100}}));
  EXPECT_TRUE(reuses(scene, {{"shadow", {{"strength", 0.5}}}}));
  const Json sun{{"type", "directional"}, {"sun", {{"azimuthDegrees", 120}, {"elevationDegrees", 35}}}};
  const auto withSun = [&](const Json& patch) {
    Json light = sun;
    light.merge_patch(patch);
    return Json{{"lights", {light}}};
  };
  EXPECT_TRUE(reuses(scene, withSun({{"intensity", 1}, {"color", {1, 0.5, 0.2}}})));
  EXPECT_FALSE(reuses(scene, withSun({{"angularDiameterDegrees", 1}})));
  EXPECT_FALSE(reuses(scene, withSun({{"sun", {{"elevationDegrees", 36}}}})));
  EXPECT_FALSE(reuses(scene, {{"nodes", {{{"node", 1}, {"castShadow", false}}}}}));
  EXPECT_FALSE(reuses(scene, {{"shadow", {{"lightMap", {{"size", 256}}}}}}));
  EXPECT_FALSE(reuses(scene, {{"shadow", {{"lightMap", {{"texelsPerMetre", 4}}}}}}));
  EXPECT_TRUE(reuses(scene, {})) << "the first is still there";
}

/// Edges lie within a texel or so: what is wrong falls with the texels' size.
TEST(LightMaps, N5_SaysWhatRaysSayTheBetterTheFiner) {
  for (const char* const name : {"box_on_plane", "mirrored_node", "double_sided"}) {
    const ScenePtr scene = generatedScene(name);
    const LightReference truth = truthOf(scene, specOf().dump());
    double before = 1;
    for (const int size : {64, 256, 1024}) {
      const Frame frame = renderJson(scene, specOf({{"shadow", {{"lightMap", {{"size", size}}}}}}).dump());
      const auto count = misclassified(floatsOf(frame), truth);
      ASSERT_GT(count.receivers, 1000u);
      const double share = static_cast<double>(count.wrong) / static_cast<double>(count.receivers);
      EXPECT_LE(share, before) << name << ' ' << size;
      before = share;
    }
    EXPECT_LT(before, 0.015) << name;
  }
}

TEST(LightMaps, N5_LightsWithASizeAreSoft) {
  const ScenePtr scene = generatedScene("box_on_plane");
  const Json sun{{"type", "directional"},
                 {"sun", {{"azimuthDegrees", 120}, {"elevationDegrees", 35}}},
                 {"angularDiameterDegrees", 5}};
  const Json lamp{{"type", "point"}, {"position", {1.5, 4.2, 2.5}}, {"intensity", 300}, {"radius", 0.2}};
  for (const Json& light : {sun, lamp}) {
    const std::string spec =
        specOf({{"lights", {light}}, {"shadow", {{"lightMap", {{"size", 1024}, {"samples", 256}}}}}}).dump();
    const LightReference truth = truthOf(scene, spec, 256);
    const Frame frame = renderJson(scene, spec);
    double sum = 0;
    std::size_t receivers = 0;
    for (std::size_t i = 0; i < truth.receiver.size(); ++i) {
      if (truth.receiver[i] == 0) continue;
      ++receivers;
      sum += std::pow(double{floatsOf(frame)[i]} - double{truth.visibility[i]}, 2);
    }
    EXPECT_LT(std::sqrt(sum / static_cast<double>(receivers)), light == lamp ? 0.03 : 0.02) << light;
  }
}

TEST(LightMaps, SamplesOfAPixelAreLookedUpOneByOne) {
  const ScenePtr scene = generatedScene("box_on_plane");
  const Frame smooth = renderJson(scene, specOf({{"antialiasing", "msaa4x"}, {"views", {"color"}}}).dump());
  const Frame traced = renderJson(
      scene,
      specOf({{"antialiasing", "msaa4x"}, {"views", {"color"}}, {"shadow", {{"technique", "rayTraced"}}}}).dump());
  const std::vector<float>& a = floatsOf(smooth);
  const std::vector<float>& b = floatsOf(traced);
  ASSERT_EQ(a.size(), b.size());
  std::size_t off = 0;
  for (std::size_t i = 0; i < a.size(); ++i) off += std::abs(a[i] - b[i]) > 0.1f ? 1 : 0;
  EXPECT_LT(static_cast<double>(off), 0.01 * static_cast<double>(a.size()));
}

void expectMovedNode(const testing::GlbBuilder& builder, const std::string& name) {
  Json spec = specOf();
  spec["camera"] = {{"eye", {3, 3, 3}}, {"target", {0, 0, 0}}};
  spec["animation"] = {{"name", "Move"}, {"timeSeconds", 1}};
  const Problems problems = refusedJson(testing::sceneOf(builder), spec.dump());
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].pointer, "/shadow/technique");
  EXPECT_NE(problems[0].detail.find("\"" + name + "\""), std::string::npos) << problems[0].detail;
}

TEST(LightMaps, APoseThatMovesANodeIsRefusedAndNamesIt) {
  testing::GlbBuilder builder = testing::plane();
  builder.json["nodes"][0]["name"] = "raft";
  animate(builder, 0, "translation", {0, 2}, {0, 0, 0, 1, 0, 0}, "VEC3");
  expectMovedNode(builder, "raft");
}

TEST(LightMaps, APoseThatBendsAMeshWithinItsBoundsIsRefusedAndNamesItsNode) {
  testing::GlbBuilder builder = testing::plane();
  const int position = builder.addPoints({{0, 0.5, 0}, {1, 0.5, 0}, {1, 1.5, 1}, {0, 1.5, 1}, {0.5, 1, 0.5}});
  const int target = builder.addPoints({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0.25f, 0, 0.125f}});
  builder.addMeshNode(builder.addMesh({{"attributes", {{"POSITION", position}}},
                                       {"indices", builder.addShortIndices({0, 1, 2, 0, 3, 4})},
                                       {"targets", {{{"POSITION", target}}}}}));
  builder.json["nodes"][0]["name"] = "raft";
  builder.json["nodes"][1]["name"] = "sail";
  animate(builder, 1, "weights", {0, 2}, {0, 1}, "SCALAR");
  expectMovedNode(builder, "sail");
}

TEST(LightMaps, APoseThatHidesTheLastNodeIsRefusedAndNamesIt) {
  testing::GlbBuilder builder = testing::plane();
  builder.addMeshNode(0);
  builder.json["nodes"][1]["name"] = "lid";
  builder.json["extensionsUsed"] = {"KHR_animation_pointer", "KHR_node_visibility"};
  const int values = builder.addAccessor(std::vector<std::uint8_t>{1, 0}, "SCALAR", 5121, 2);
  addChannel(builder, pointerTarget("/nodes/1/extensions/KHR_node_visibility/visible"), {0, 1}, values, "STEP");
  builder.json["animations"][0]["name"] = "Move";
  expectMovedNode(builder, "lid");
}

/// The back of a panel on a wall: a micrometre before it, and turned away from the camera.
TEST(LightMaps, SurfacesThatTouchDoNotShadowEachOther) {
  testing::GlbBuilder builder;
  testing::addSquare(builder, 4, 0);
  constexpr float kGap = 1e-6f;
  testing::addQuad(builder, {{-2, kGap, -2}, {2, kGap, -2}, {2, kGap, 2}, {-2, kGap, 2}});
  const ScenePtr scene = testing::sceneOf(builder);
  Json spec = specOf();
  spec["camera"] = {{"eye", {0, 9, 5}}, {"target", {0, 0, 0}}};
  const auto count = misclassified(floatsOf(renderJson(scene, spec.dump())), truthOf(scene, spec.dump()));
  EXPECT_GT(count.receivers, 10000u);
  EXPECT_EQ(count.wrong, 0u);
}

} // namespace
} // namespace gnomon
