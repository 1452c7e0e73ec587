// Tiles that are kept between frames: nothing but the work may change.
#include <thread>

#include "tests/renderer/frame_fixture.h"
#include "tests/support/tested_device.h"

namespace gnomon {
namespace {
/// The frames that a renderer of its own draws, one after the other.
std::vector<Frame> drawn(const std::vector<std::pair<ScenePtr, Json>>& requests, std::size_t tileCacheBytes) {
  std::vector<Frame> frames;
  // A context of its own needs a thread of its own.
  std::thread([&] {
    auto renderer = Renderer::create({.backend = testing::testedBackend(), .tileCacheBytes = tileCacheBytes});
    ASSERT_TRUE(renderer);
    for (const auto& [scene, spec] : requests) {
      const auto decoded = decodeFrameSpec(testing::withMaps(spec).dump());
      ASSERT_TRUE(decoded) << decoded.problems()[0].pointer << decoded.problems()[0].detail;
      auto frame = renderer->render(scene, *decoded);
      ASSERT_TRUE(frame) << frame.problems()[0].detail;
      frames.push_back(*std::move(frame));
    }
  }).join();
  return frames;
}

Json requestFrom(double x, const std::string& stabilization, const std::string& filter) {
  return {{"width", 200},
          {"height", 120},
          {"camera", {{"eye", {x, 3, 9}}, {"target", {x, 1, 0}}, {"up", {0, 1, 0}}}},
          {"lights",
           {{{"type", "directional"}, {"sun", Json::object()}},
            {{"type", "spot"}, {"position", {4, 6, 4}}, {"direction", {-4, -6, -4}}, {"intensity", 40}},
            {{"type", "point"}, {"position", {-3, 3, 2}}, {"intensity", 20}}}},
          {"shadow",
           {{"stabilization", stabilization},
            {"depthRange", {{"mode", "manual"}, {"min", 0}, {"max", 30}}},
            {"filter", {{"type", filter}}}}},
          {"antialiasing", "none"},
          {"views", {"color", "shadow"}},
          {"output", {{"format", "exr"}}}};
}

void expectEqual(const Frame& a, const Frame& b, const std::string& what) {
  ASSERT_EQ(a.images.size(), b.images.size());
  for (std::size_t i = 0; i < a.images.size(); ++i)
    EXPECT_TRUE(a.images[i].image.pixels == b.images[i].image.pixels) << what;
}

int tilesWhere(const Frame& frame, bool reused) {
  int count = 0;
  for (const LightReport& light : frame.report.lights) {
    for (const TileReport& tile : light.tiles) count += tile.tile[2] > 0 && tile.reused == reused ? 1 : 0;
  }
  return count;
}

TEST(TileCache, H13_BytesAreTheSameWithAndWithout) {
  const ScenePtr box = testing::generatedScene("box_on_plane");
  const ScenePtr leaf = testing::generatedScene("mask_leaf");
  for (const char* filter : {"hard", "pcf", "evsm"}) {
    std::vector<std::pair<ScenePtr, Json>> requests;
    for (const double x : {0.0, 0.0, 0.3, 0.0, 2.5}) {
      for (const char* stabilization : {"projectionSnapping", "none"}) {
        requests.emplace_back(box, requestFrom(x, stabilization, filter));
        requests.emplace_back(leaf, requestFrom(x, stabilization, filter));
      }
    }
    const auto with = drawn(requests, std::size_t{1} << 28);
    const auto without = drawn(requests, 0);
    ASSERT_EQ(with.size(), requests.size());
    ASSERT_EQ(without.size(), requests.size());
    int reused = 0;
    for (std::size_t i = 0; i < with.size(); ++i) {
      expectEqual(with[i], without[i], filter + std::string(", request ") + std::to_string(i));
      EXPECT_EQ(tilesWhere(without[i], true), 0);
      reused += tilesWhere(with[i], true);
    }
    EXPECT_GT(reused, 40);
  }
}

TEST(TileCache, H13_X24_AnotherCameraRedrawsOnlyTheTilesWhoseMatrixChanged) {
  const ScenePtr box = testing::generatedScene("box_on_plane");
  const auto frames =
      drawn({{box, requestFrom(0, "projectionSnapping", "pcf")}, {box, requestFrom(0.02, "projectionSnapping", "pcf")}},
            1 << 28);
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_GT(tilesWhere(frames[1], true), 2)
      << "the far cascades' texels are larger than the step; the lamps' tiles stand";
  for (const LightReport& light : frames[1].report.lights) {
    for (const TileReport& tile : light.tiles) {
      if (tile.reused) {
        EXPECT_EQ(tile.casterTriangles, 0u);
      }
    }
  }
  for (std::size_t lamp : {1u, 2u}) {
    for (const TileReport& tile : frames[1].report.lights[lamp].tiles) EXPECT_TRUE(tile.reused || tile.tile[2] == 0);
  }
}

TEST(TileCache, H13_WhatATileDependsOnIsInItsKey) {
  const ScenePtr box = testing::generatedScene("box_on_plane");
  const Json first = requestFrom(0, "none", "evsm");
  for (const char* change :
       {R"({"filter":{"type":"evsm","size":7}})", R"({"filter":{"type":"msm"}})", R"({"size":"Small"})"}) {
    Json second = first;
    second["shadow"].merge_patch(Json::parse(change));
    const auto frames = drawn({{box, first}, {box, second}}, 1 << 28);
    ASSERT_EQ(frames.size(), 2u);
    EXPECT_EQ(tilesWhere(frames[1], true), 0) << change;
  }
}

} // namespace
} // namespace gnomon
