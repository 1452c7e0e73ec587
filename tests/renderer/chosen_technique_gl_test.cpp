// What technique auto does to a frame: it chooses, says so, plans the map all the same, and draws it only where asked.
#include "tests/renderer/frame_fixture.h"

namespace gnomon {
namespace {

Frame drawn(const ScenePtr& scene, const FrameSpec& spec) {
  auto frame = testing::sharedRenderer().render(scene, spec);
  EXPECT_TRUE(frame) << frame.problems()[0].detail;
  return frame ? *std::move(frame) : Frame{};
}

FrameSpec sunOverABox(const std::vector<View>& views = {View::color}) {
  FrameSpec spec;
  spec.width = 160;
  spec.height = 90;
  spec.views = views;
  return spec;
}

ShadowTechnique usualChoice() {
  return testing::drawnByGpu() ? ShadowTechnique::shadowMap : ShadowTechnique::rayTraced;
}

TEST(ChosenTechnique, IsReportedAndNamedByTheEffectiveSpec) {
  const ScenePtr box = testing::generatedScene("box_on_plane");
  const Frame frame = drawn(box, sunOverABox());
  const LightReport& light = frame.report.lights.at(0);
  ASSERT_TRUE(light.choice);
  EXPECT_EQ(light.choice->technique, usualChoice());
  EXPECT_EQ(frame.report.spec.lights->at(0).shadow->technique, usualChoice());
  const Frame again = drawn(box, frame.report.spec);
  EXPECT_TRUE(again.images[0].image.pixels == frame.images[0].image.pixels);
  EXPECT_FALSE(again.report.lights.at(0).choice) << "its technique was named";
}

TEST(ChosenTechnique, PlansTheMapOfALightThatRaysDecideAndDrawsItWhereAViewShowsIt) {
  if (testing::drawnByGpu()) GTEST_SKIP() << "a GPU draws the map";
  const ScenePtr box = testing::generatedScene("box_on_plane");
  const Frame plain = drawn(box, sunOverABox());
  const LightReport& planned = plain.report.lights.at(0);
  ASSERT_EQ(planned.tiles.size(), 4u);
  EXPECT_GT(planned.tiles[0].tile[2], 0);
  EXPECT_TRUE(planned.depthRange);
  EXPECT_EQ(planned.casterTriangles, 0u);
  EXPECT_FALSE(planned.predictedError);
  EXPECT_EQ(plain.report.atlasSize[0], 0);

  const Frame shown = drawn(box, sunOverABox({View::color, View::cascades}));
  EXPECT_GT(shown.report.lights.at(0).casterTriangles, 0u);
  EXPECT_EQ(shown.report.lights.at(0).tiles[0].matrix, planned.tiles[0].matrix);
  EXPECT_TRUE(shown.images[0].image.pixels == plain.images[0].image.pixels);
}

TEST(ChosenTechnique, IsTheSameInAPlan) {
  const ScenePtr box = testing::generatedScene("box_on_plane");
  const auto plan = planFrame(box, sunOverABox(), testing::sharedRenderer().info());
  ASSERT_TRUE(plan);
  ASSERT_TRUE(plan->lights.at(0).choice);
  EXPECT_EQ(plan->lights[0].choice->technique, usualChoice());
  ASSERT_EQ(plan->lights[0].tiles.size(), 4u);
  EXPECT_GT(plan->lights[0].tiles[0].casterTriangles, 0u) << "counted whether it is drawn or not";
  EXPECT_TRUE(plan->lights[0].tiles[0].predictedError);
}

TEST(ChosenTechnique, IsAMapForLeavesButWhereOpenGlDrawsItInSoftware) {
  const RendererInfo& info = testing::sharedRenderer().info();
  const auto plan = planFrame(testing::generatedScene("leaves"), FrameSpec{}, info);
  ASSERT_TRUE(plan);
  const bool slowMaps = info.device == DeviceChoice::gl && info.software;
  EXPECT_EQ(plan->lights.at(0).choice->technique, slowMaps ? ShadowTechnique::rayTraced : ShadowTechnique::shadowMap);
}

TEST(ChosenTechnique, TakesNoMoreMemoryForRaysThanAFrameMayHave) {
  FrameSpec spec = sunOverABox();
  spec.width = 8192;
  spec.height = 4096;
  spec.antialiasing = Antialiasing::none;
  spec.lights = std::vector<Light>(12); // rays would take 64 MiB each, of 512
  const auto plan = planFrame(testing::generatedScene("box_on_plane"), spec, testing::sharedRenderer().info());
  ASSERT_TRUE(plan) << plan.problems()[0].detail;
  if (testing::drawnByGpu()) return;
  int rays = 0;
  for (const LightReport& light : plan->lights) rays += light.choice->technique == ShadowTechnique::rayTraced ? 1 : 0;
  EXPECT_EQ(rays, 8);
  EXPECT_NE(plan->lights.back().choice->why.find("memory"), std::string::npos);
}

} // namespace
} // namespace gnomon
