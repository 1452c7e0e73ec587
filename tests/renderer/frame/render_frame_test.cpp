// A frame from top to bottom over a device that draws nothing: no OpenGL is linked here.
#include "renderer/frame/render_frame.h"

#include <gtest/gtest.h>

#include "renderer/prepare/box_depths.h"
#include "renderer/prepare/frame_geometry.h"
#include "tests/renderer/frame/squares.h"

namespace gnomon {
namespace {

/// What was asked of the device, call by call.
struct Asked {
  std::vector<std::string> calls;
  std::vector<ViewRequest> views;
  std::size_t tiles = 0;
};

class FakeDrawing : public FrameDrawing {
 public:
  FakeDrawing(const FrameWork& work, Asked& asked, Status end) : work_(work), asked_(asked), end_(std::move(end)) {}

  /// Boxes stand in for surfaces.
  Result<SeenDepths> survey() override {
    asked_.calls.emplace_back("survey");
    const SceneView& view = work_.scene->scenes[0];
    const FrameGeometry geometry = frameGeometry(*work_.scene, view, work_.frame.view.eye);
    const std::vector<std::uint8_t> all(geometry.slotCount(), 1);
    return SeenDepths{
        boxDepths(work_.frame.view, work_.frame.spec.width, work_.frame.spec.height, geometry.slotBounds, all), {}};
  }

  Status cast(const ShowInput& input, TileUse) override {
    asked_.calls.emplace_back("cast");
    asked_.tiles = input.plan.tiles.size();
    facts_.tiles.resize(input.plan.tiles.size());
    for (TileFacts& tile : facts_.tiles) tile.casterTriangles = 2;
    return Done{};
  }

  Status show(const ShowInput& input) override {
    asked_.calls.emplace_back("show");
    asked_.views.assign(input.views.begin(), input.views.end());
    return Done{};
  }

  Result<std::vector<PlacedTriangle>> shownTriangles() override { return std::vector<PlacedTriangle>{}; }
  Result<std::vector<MapFootprint>> footprints(const ShowInput&) override { return std::vector<MapFootprint>{}; }
  Result<std::vector<float>> probe(const ShowInput&, std::span<const ProbePoint> points) override {
    return std::vector<float>(points.size(), 1.0f);
  }

  /// Black, but for shadows, which are lit.
  Image picture(std::size_t index) override {
    const auto pixels = static_cast<std::size_t>(work_.frame.spec.width) * work_.frame.spec.height;
    Image image{work_.frame.spec.width, work_.frame.spec.height, {"R", "G", "B"}, {}};
    if (asked_.views[index].encoded) {
      image.pixels = std::vector<std::uint8_t>(3 * pixels);
    } else {
      image.channels = {"Y"};
      image.pixels = std::vector<float>(pixels, 1.0f);
    }
    return image;
  }

  void endStage(std::string name) override { facts_.stages.push_back({std::move(name), 1.0}); }

  Result<FrameFacts> finish() override {
    if (!end_) return end_.problems();
    facts_.passes = {{.pass = "survey", .drawCalls = 3, .triangles = 4}};
    facts_.surveyedTriangles = 4;
    facts_.memory.scene = 77;
    return facts_;
  }

 private:
  const FrameWork work_;
  Asked& asked_;
  Status end_;
  FrameFacts facts_;
};

class FakeDevice : public Device {
 public:
  explicit FakeDevice(Status end = Done{}) : end_(std::move(end)) {
    info_.maxTextureSize = 4096;
    info_.maxSamples = 4;
  }

  const RendererInfo& info() const override { return info_; }
  Result<std::unique_ptr<FrameDrawing>> begin(const FrameWork& work) override {
    asked.calls.emplace_back("begin");
    return std::unique_ptr<FrameDrawing>(std::make_unique<FakeDrawing>(work, asked, end_));
  }

  Asked asked;

 private:
  RendererInfo info_;
  Status end_;
};

FrameSpec sunlit() {
  FrameSpec spec;
  spec.width = 64;
  spec.height = 48;
  Light sun;
  sun.direction = Vec3{0.3, -1, 0.2};
  spec.lights = std::vector{sun};
  spec.shadow.cascadeCount = 2;
  return spec;
}

TEST(RenderFrame, PlansDrawsAndReportsOverAnyDevice) {
  FakeDevice device;
  FrameCaches caches{TracedSceneCache(0), LightMapCache(1u << 28), VolumeCache(1u << 28)};
  const auto frame = renderFrame(device, caches, testing::squares(), sunlit());
  ASSERT_TRUE(frame) << frame.problems().front().detail;
  EXPECT_EQ(device.asked.calls, (std::vector<std::string>{"begin", "survey", "cast", "show"}));
  EXPECT_EQ(device.asked.tiles, 2u);
  ASSERT_EQ(frame->images.size(), 1u);
  EXPECT_EQ(frame->images[0].image.width, 64);

  const FrameReport& report = frame->report;
  ASSERT_EQ(report.lights.size(), 1u);
  ASSERT_EQ(report.lights[0].tiles.size(), 2u);
  EXPECT_TRUE(report.lights[0].shadowed);
  EXPECT_EQ(report.lights[0].casterTriangles, 4u) << "what the device says of each tile, summed";
  EXPECT_GT(report.depthRange[1], report.depthRange[0]);
  EXPECT_GT(report.atlasSize[0], 0);
  EXPECT_TRUE(report.predictedError);
  EXPECT_EQ(report.counts.sceneTriangles, 4u);
  EXPECT_EQ(report.counts.surveyedTriangles, 4u);
  EXPECT_EQ(report.counts.drawCalls, 3u);
  EXPECT_EQ(report.memory.scene, 77u);
  ASSERT_EQ(report.stages.size(), 5u);
  EXPECT_EQ(report.stages[1].stage, "plan");
}

TEST(RenderFrame, AViewThatComparesWithRaysAsksForItsShadowAndABackdrop) {
  FakeDevice device;
  FrameCaches caches{TracedSceneCache(1 << 20), LightMapCache(1u << 28), VolumeCache(1u << 28)};
  FrameSpec spec = sunlit();
  spec.views = {View::error, View::depth};
  const auto frame = renderFrame(device, caches, testing::squares(), spec);
  ASSERT_TRUE(frame) << frame.problems().front().detail;
  ASSERT_EQ(device.asked.views.size(), 3u) << "the error itself is drawn by no device";
  EXPECT_EQ(device.asked.views[0].view, View::depth);
  EXPECT_EQ(device.asked.views[1].view, View::shadow);
  EXPECT_TRUE(device.asked.views[1].fullStrength);
  EXPECT_FALSE(device.asked.views[1].encoded);
  EXPECT_EQ(device.asked.views[2].view, View::color);
  ASSERT_EQ(frame->images.size(), 2u);
  EXPECT_EQ(frame->images[0].view, View::error);
  ASSERT_TRUE(frame->report.error);
  EXPECT_GT(frame->report.error->falseLit, 0) << "the fake's shadow is lit everywhere, and the square throws one";
}

TEST(RenderFrame, WhatADeviceCannotDrawIsRefusedBeforeItBegins) {
  FakeDevice device;
  FrameCaches caches{TracedSceneCache(0), LightMapCache(1u << 28), VolumeCache(1u << 28)};
  FrameSpec spec = sunlit();
  spec.width = 5000;
  const auto frame = renderFrame(device, caches, testing::squares(), spec);
  ASSERT_FALSE(frame);
  EXPECT_EQ(frame.problems().front().pointer, "/width");
  EXPECT_TRUE(device.asked.calls.empty());
}

TEST(RenderFrame, ABakeThatIsStoppedEndsTheFrameAndTheNextOneBakes) {
  FakeDevice device;
  FrameCaches caches{TracedSceneCache(1 << 20), LightMapCache(1u << 28), VolumeCache(1u << 28)};
  FrameSpec spec = sunlit();
  spec.shadow.technique = ShadowTechnique::lightMap;
  spec.shadow.lightMap.size = 64;
  const auto stopped = renderFrame(device, caches, testing::squares(), spec, TileUse::kept, [] { return false; });
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.problems().front().code, ProblemCode::unavailable);
  const auto frame = renderFrame(device, caches, testing::squares(), spec, TileUse::kept, [] { return true; });
  ASSERT_TRUE(frame) << frame.problems().front().detail;
  ASSERT_TRUE(frame->report.lights[0].lightMap);
  EXPECT_FALSE(frame->report.lights[0].lightMap->reused);
}

TEST(RenderFrame, AProblemOfTheDeviceIsTheFrames) {
  FakeDevice device(Problem{ProblemCode::backend, "", "The device is gone.", "", ""});
  FrameCaches caches{TracedSceneCache(0), LightMapCache(1u << 28), VolumeCache(1u << 28)};
  const auto frame = renderFrame(device, caches, testing::squares(), sunlit());
  ASSERT_FALSE(frame);
  EXPECT_EQ(frame.problems().front().code, ProblemCode::backend);
}

} // namespace
} // namespace gnomon
