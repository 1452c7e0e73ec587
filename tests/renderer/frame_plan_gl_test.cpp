// What a plan says, held against the frame.
#include "protocol/json/json_codec.h"
#include "tests/renderer/frame_fixture.h"
#include "tests/renderer/scene/animation/animated.h"

namespace gnomon {
namespace {

using testing::renderJson;

const char* const kThreeLights = R"({"width":96,"height":64,"views":["color","shadow"],"lights":[
    {"sun":{"azimuthDegrees":120,"elevationDegrees":35}},
    {"type":"spot","position":[3,4,2],"direction":[-3,-4,-2],"range":20,"shadow":{"size":"Small"}},
    {"type":"point","position":[-2,3,1],"range":15}]})";

TEST(FramePlans, HoldWhatTheFrameHolds) {
  for (const char* name : {"box_on_plane", "long_row", "thin_slats"}) {
    const ScenePtr scene = testing::generatedScene(name);
    const auto spec = decodeFrameSpec(testing::withMaps(Json::parse(kThreeLights)).dump());
    ASSERT_TRUE(spec);
    const Frame frame = renderJson(scene, kThreeLights);
    const auto plan = planFrame(scene, *spec, testing::sharedRenderer().info());
    ASSERT_TRUE(plan);
    EXPECT_EQ(plan->spec, frame.report.spec);
    EXPECT_LE(plan->depthRange[0], frame.report.depthRange[0]) << name;
    EXPECT_GE(plan->depthRange[1], frame.report.depthRange[1]) << name;
    for (std::size_t i = 0; i < plan->lights.size(); ++i) {
      const LightReport& planned = plan->lights[i];
      const LightReport& drawn = frame.report.lights[i];
      EXPECT_EQ(planned.askedTileSize, drawn.askedTileSize);
      EXPECT_GE(planned.shadowed, drawn.shadowed);
      EXPECT_FALSE(planned.cpuMilliseconds || planned.gpuMilliseconds);
      if (i == 0 || !drawn.shadowed) continue; // faces, other than cascades, lie where the frame's do
      ASSERT_EQ(planned.tiles.size(), drawn.tiles.size());
      EXPECT_GE(planned.casterTriangles, drawn.casterTriangles) << name << i;
      for (std::size_t tile = 0; tile < drawn.tiles.size(); ++tile) {
        EXPECT_TRUE(planned.tiles[tile].matrix || !drawn.tiles[tile].matrix) << "a superset of the tiles";
      }
    }
  }
}

/// A square that moves within a second.
ScenePtr moving() {
  testing::GlbBuilder builder = testing::plane();
  animate(builder, 0, "translation", {0, 1}, {0, 0, 0, 1, 0, 0}, "VEC3");
  return testing::sceneOf(builder);
}

std::string told(const Problems& problems) {
  std::string text;
  for (const Problem& each : problems) {
    text += std::string(problemName(each.code)) + " " + each.pointer + " " + each.detail + " " + each.limit + " " +
            each.actual + "\n";
  }
  return text;
}

TEST(FramePlans, RefuseWhatTheFrameRefuses) {
  const char* const volume =
      R"({"volumes":[{"file":"none.npy","box":{"min":[0,0,0],"max":[1,1,1]},"transferFunction":[{"value":0}]}]})";
  const std::vector<std::pair<const char*, std::vector<std::string>>> refusals = {
      {R"({"scene":7})", {"/scene"}},
      {R"({"materialVariant":"none"})", {"/materialVariant"}},
      {R"({"camera":{"node":"nobody"}})", {"/camera/node"}},
      {R"({"nodes":[{"node":"nobody","visible":false}]})", {"/nodes/0/node"}},
      {R"({"animation":{"index":3}})", {"/animation/index"}},
      {R"({"views":["motion"],"motionFrom":{"animation":{"index":3}}})", {"/motionFrom/animation/index"}},
      {R"({"views":["motion"],"motionFrom":{"camera":{"node":"nobody"}}})", {"/motionFrom/camera/node"}},
      {R"({"views":["motion"],"motionFrom":{"nodes":[{"node":"nobody","scale":[1,2,1]}]}})",
       {"/motionFrom/nodes/0/node"}},
      {R"({"shadow":{"technique":"lightMap"},"animation":{"index":0,"timeSeconds":1}})", {"/shadow/technique"}},
      {R"({"debug":{"light":9}})", {"/debug/light"}},
      {R"({"views":["tile"],"shadow":{"cascadeCount":1},"debug":{"tile":3}})", {"/debug/tile"}},
      {R"({"views":["atlas"],"shadow":{"enabled":false}})", {"/views"}},
      {volume, {"/volumes/0/file"}},
      {R"({"scene":7,"materialVariant":"none","nodes":[{"node":9,"visible":false}],"views":["motion"],
           "motionFrom":{"animation":{"index":3}}})",
       {"/scene", "/materialVariant", "/nodes/0/node", "/motionFrom/animation/index"}},
      {R"({"camera":{"node":"nobody"},"debug":{"light":9},"shadow":{"technique":"lightMap"},
           "animation":{"index":0,"timeSeconds":1}})",
       {"/camera/node", "/debug/light", "/shadow/technique"}}};
  const ScenePtr scene = moving();
  for (const auto& [text, pointers] : refusals) {
    const auto spec = decodeFrameSpec(testing::withMaps(Json::parse(text)).dump());
    ASSERT_TRUE(spec) << text;
    const auto plan = planFrame(scene, *spec, testing::sharedRenderer().info());
    ASSERT_FALSE(plan) << text;
    EXPECT_EQ(told(plan.problems()), told(testing::refusedJson(scene, text))) << text;
    std::vector<std::string> found;
    for (const Problem& problem : plan.problems()) found.push_back(problem.pointer);
    EXPECT_EQ(found, pointers) << text;
  }
}

TEST(FramePlans, X8_AnAtlasBeyondTheDeviceIsRefusedAndOneThatIsFullSaysSo) {
  const ScenePtr scene = testing::generatedScene("box_on_plane");
  RendererInfo device;
  device.maxTextureSize = 512;
  device.maxSamples = 1;
  FrameSpec spec;
  spec.width = 512;
  spec.height = 288;
  const auto refused = planFrame(scene, spec, device);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.problems()[0].pointer, "/atlas/size");
  spec.atlas.size = spec.atlas.baseSize = 512;
  const auto plan = planFrame(scene, spec, device);
  ASSERT_TRUE(plan);
  EXPECT_LE(plan->atlasSize[0], 512);
  EXPECT_LT(plan->lights[0].grantedTileSize, plan->lights[0].askedTileSize);
  EXPECT_NE(plan->lights[0].note.find("is full"), std::string::npos) << plan->lights[0].note;
}

} // namespace
} // namespace gnomon
