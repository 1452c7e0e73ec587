// Volumes in frames: what lies behind them, in their shadow, and in the shadow of others.
#include <algorithm>
#include <cmath>

#include "tests/renderer/frame_fixture.h"
#include "tests/renderer/made_grids.h"

namespace gnomon {
namespace {

using testing::floatsOf;
using testing::refusedJson;
using testing::renderJson;
using testing::valueAt;

constexpr double kSigma = 0.35; // per metre

Bytes solidGrid(int x, int y, int z) {
  return testing::byteGrid(x, y, z, [](int, int, int) { return 255; });
}

/// A ground of 100 m, and over x < 0 a sheet at y = 20; `grid`: the file solid.npy.
ScenePtr groundScene(const Bytes& grid = solidGrid(3, 3, 3)) {
  testing::GlbBuilder builder = testing::plane();
  builder.json["nodes"][0]["scale"] = {50, 1, 50};
  builder.addRoot({{"mesh", 0}, {"scale", {25, 1, 50}}, {"translation", {-25, 20, 0}}, {"name", "sheet"}});
  SceneBundle bundle = builder.bundle();
  bundle.files["solid.npy"] = grid;
  bundle.files["broken.npy"] = Bytes(grid.begin(), grid.begin() + 100);
  return testing::sceneOf(bundle);
}

Json stops(double sigma, const Json& color) {
  return Json::array(
      {{{"value", 0}, {"color", color}, {"extinction", 0}}, {{"value", 255}, {"color", color}, {"extinction", sigma}}});
}

/// A slab of soot from y = 4 to y = 6 over x, z = -20..20.
Json slab(const Json& patch = {}) {
  Json volume{{"file", "solid.npy"},
              {"box", {{"min", {-20, 4, -20}}, {"max", {20, 6, 20}}}},
              {"transferFunction", stops(kSigma, {0, 0, 0})}};
  if (!patch.is_null()) volume.merge_patch(patch);
  return volume;
}

/// Seen from above, 80 m across, under a sun overhead; the sheet is hidden and casts nothing.
Json specOf(const std::vector<Json>& volumes, const Json& patch = {}) {
  Json spec{
      {"width", 80},
      {"height", 80},
      {"camera", {{"eye", {0, 10, 0}}, {"target", {0, 0, 0}}, {"up", {0, 0, -1}}, {"orthographic", {{"height", 80}}}}},
      {"lights", {{{"type", "directional"}, {"direction", {0, -1, 0}}}}},
      {"antialiasing", "none"},
      {"nodes", {{{"node", "sheet"}, {"visible", false}}}},
      {"volumes", volumes},
      {"views", {"color", "shadow"}},
      {"output", {{"format", "exr"}, {"exrPixelType", "float"}}}};
  if (!patch.is_null()) spec.merge_patch(patch);
  return spec;
}

Frame rendered(const ScenePtr& scene, const std::vector<Json>& volumes, const Json& patch = {}) {
  return renderJson(scene, specOf(volumes, patch).dump());
}

/// Red of view color at a place of the picture.
double redAt(const Frame& frame, double x, double y) {
  const Image& image = frame.images[0].image;
  const auto column = static_cast<std::size_t>(x * image.width), row = static_cast<std::size_t>(y * image.height);
  return double{floatsOf(frame)[(row * static_cast<std::size_t>(image.width) + column) * image.channels.size()]};
}

TEST(VolumeFrames, D5_D6_D7_ASlabsShadowIsOneLessExpOfSigmaL) {
  for (const int voxels : {1, 3, 40}) {
    const ScenePtr scene = groundScene(solidGrid(voxels, voxels, voxels));
    for (const double elevation : {90.0, 60.0, 30.0}) {
      const Json sun{
          {"lights", {{{"type", "directional"}, {"sun", {{"azimuthDegrees", 90}, {"elevationDegrees", elevation}}}}}}};
      const Frame frame = rendered(scene, {slab()}, sun);
      const double taken = 1 - std::exp(-kSigma * 2 / std::sin(glm::radians(elevation)));
      const double shadow = double{valueAt(frame, 0.45, 0.5, 1)};
      EXPECT_NEAR(1 - shadow, taken, 0.005 * taken) << voxels << ' ' << elevation;
      EXPECT_NEAR(valueAt(frame, 0.95, 0.5, 1), 1, 1e-6) << "no light on its way there meets the box";
      EXPECT_NEAR(valueAt(frame, 0.5, 0.05, 1), 1, 1e-6);
    }
  }
}

TEST(VolumeFrames, D7_SeveralThatOverlapAddUp) {
  const ScenePtr scene = groundScene();
  const Json other = slab({{"box", {{"min", {0, 3, -20}}, {"max", {30, 5, 20}}}}});
  const Frame frame = rendered(scene, {slab(), other});
  for (const auto& [x, metres] : {std::pair(0.4, 2.0), std::pair(0.6, 4.0), std::pair(0.8, 2.0)}) {
    EXPECT_NEAR(valueAt(frame, x, 0.5, 1), std::exp(-kSigma * metres), 0.003) << x;
  }
  const Frame without = rendered(scene, {});
  EXPECT_NEAR(redAt(frame, 0.6, 0.5) / redAt(without, 0.6, 0.5), std::exp(-kSigma * 4), 0.2);
  EXPECT_LT(redAt(frame, 0.6, 0.5), redAt(frame, 0.4, 0.5));
}

TEST(VolumeFrames, D6_ItTakesItsShareOfWhatSurfacesLetThrough) {
  const ScenePtr scene = groundScene();
  const Json sheetCasts{{"nodes", {{{"node", "sheet"}, {"visible", false}, {"castShadow", true}}}}};
  const Frame frame = rendered(scene, {slab()}, sheetCasts);
  EXPECT_EQ(valueAt(frame, 0.4, 0.5, 1), 0);
  EXPECT_NEAR(valueAt(frame, 0.6, 0.5, 1), std::exp(-2 * kSigma), 0.003);
  Json weak = sheetCasts;
  weak["shadow"] = {{"strength", 0.5}};
  const Frame half = rendered(scene, {slab()}, weak);
  EXPECT_NEAR(valueAt(half, 0.4, 0.5, 1), 0.5, 1e-3) << "both are shadow, and darken once";
  EXPECT_NEAR(valueAt(half, 0.6, 0.5, 1), 0.5 + 0.5 * std::exp(-2 * kSigma), 0.003);
  const Frame exact = rendered(scene, {slab()}, Json{{"shadow", {{"technique", "rayTraced"}}}});
  EXPECT_NEAR(valueAt(exact, 0.6, 0.5, 1), std::exp(-2 * kSigma), 0.003);
}

TEST(VolumeFrames, D7_SurfacesThrowTheirShadowsOnIt) {
  const ScenePtr scene = groundScene(solidGrid(40, 4, 4));
  const Json white = slab({{"transferFunction", stops(20, {1, 1, 1})}});
  Json patch{{"nodes", {{{"node", "sheet"}, {"visible", false}, {"castShadow", true}}}},
             {"ambient", {{"intensity", 0}}}};
  const Frame shaded = rendered(scene, {white}, patch);
  EXPECT_NEAR(redAt(shaded, 0.4, 0.5), 0, 1e-4) << "under the sheet";
  EXPECT_GT(redAt(shaded, 0.6, 0.5), 0.3);
  Json lit = white;
  lit["receiveShadow"] = false;
  const Frame plain = rendered(scene, {lit}, patch);
  EXPECT_NEAR(redAt(plain, 0.4, 0.5), redAt(plain, 0.6, 0.5), 1e-4);
  EXPECT_GT(redAt(plain, 0.4, 0.5), 0.3);
}

TEST(VolumeFrames, ABackgroundShowsThroughIt) {
  const ScenePtr scene = groundScene();
  const Json patch{{"nodes", {{{"node", 0}, {"visible", false}}, {{"node", "sheet"}, {"visible", false}}}},
                   {"background", {{"color", {0.5, 0.5, 0.5}}, {"alpha", 0}}}};
  const Frame frame = rendered(scene, {slab()}, patch);
  EXPECT_NEAR(redAt(frame, 0.5, 0.5), 0.5 * std::exp(-2 * kSigma), 0.003);
  EXPECT_NEAR(redAt(frame, 0.02, 0.02), 0.5, 1e-6);
  const Image& image = frame.images[0].image;
  ASSERT_EQ(image.channels.size(), 4u);
  EXPECT_NEAR(floatsOf(frame)[(40 * 80 + 40) * 4 + 3], 1 - std::exp(-2 * kSigma), 0.003);
}

TEST(VolumeFrames, ViewsOfSurfacesAndMeasuresOfTheirShadowsDoNotKnowIt) {
  const ScenePtr scene = groundScene();
  const Json patch{{"views", {"depth", "normal", "reference", "error"}},
                   {"nodes", {{{"node", "sheet"}, {"visible", false}, {"castShadow", true}}}}};
  const Frame with = rendered(scene, {slab()}, patch);
  const Frame without = rendered(scene, {}, patch);
  for (std::size_t view = 0; view < 4; ++view) EXPECT_EQ(floatsOf(with, view), floatsOf(without, view)) << view;
}

bool hasStage(const Frame& frame) {
  return std::any_of(frame.report.stages.begin(), frame.report.stages.end(),
                     [](const StageTime& stage) { return stage.stage == "volume"; });
}

TEST(VolumeFrames, D5_LightIsMadeAnewOnlyWhereVolumeLightOrCastersChange) {
  const ScenePtr scene = groundScene();
  const auto reused = [&](const Json& volume, const Json& patch = {}) {
    const Frame frame = rendered(scene, {volume}, patch);
    EXPECT_TRUE(hasStage(frame));
    return frame.report.volumes.at(0).reused;
  };
  EXPECT_FALSE(reused(slab()));
  EXPECT_TRUE(reused(slab()));
  EXPECT_TRUE(reused(slab(), {{"width", 40}, {"shadow", {{"filter", {{"type", "hard"}}}}}}));
  EXPECT_FALSE(reused(slab({{"box", {{"max", {20, 7, 20}}}}})));
  EXPECT_FALSE(reused(slab({{"transferFunction", stops(1, {1, 1, 1})}})));
  EXPECT_FALSE(reused(slab(), {{"lights", {{{"type", "directional"}, {"direction", {0.1, -1, 0}}}}}}));
  EXPECT_FALSE(reused(slab(), {{"nodes", {{{"node", "sheet"}, {"visible", false}, {"castShadow", true}}}}}));
  EXPECT_TRUE(reused(slab()));
  const Frame frame = rendered(scene, {slab()});
  EXPECT_EQ(frame.report.volumes[0].voxels, (std::array{3, 3, 3}));
  EXPECT_EQ(frame.report.volumes[0].values, (std::array{255.0, 255.0}));
  EXPECT_EQ(frame.report.volumes[0].lightSize, (std::array{4, 4, 4}));
  EXPECT_EQ(frame.report.volumes[0].lightBytes, 64u * 16u);
  const Frame none = rendered(scene, {});
  EXPECT_FALSE(hasStage(none));
  EXPECT_TRUE(none.report.volumes.empty());
}

TEST(VolumeFrames, WhatCannotBeDrawnIsRefusedWithItsPlace) {
  const ScenePtr scene = groundScene();
  const auto pointer = [&](const Json& volume, const Json& patch = {}) {
    const Problems problems = refusedJson(scene, specOf({volume}, patch).dump());
    return problems.empty() ? std::string("nothing") : problems[0].pointer;
  };
  EXPECT_EQ(pointer(slab({{"file", "other.npy"}})), "/volumes/0/file");
  EXPECT_EQ(pointer(slab({{"file", "broken.npy"}})), "/volumes/0/file");
  EXPECT_EQ(pointer(slab({{"grid", "density"}})), "/volumes/0/file");
  Json flat = slab({{"matrix", {1, 0, 0, 0, 2, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}});
  flat.erase("box");
  EXPECT_EQ(pointer(flat), "/volumes/0/matrix");
  Json lights = Json::array();
  for (int i = 0; i < 17; ++i) lights.push_back({{"type", "directional"}, {"direction", {0, -1, 0}}});
  EXPECT_EQ(pointer(slab(), {{"lights", lights}}), "/lights");
  EXPECT_EQ(pointer(slab(), {{"width", 8192}, {"height", 4096}}), "/volumes");
}

} // namespace
} // namespace gnomon
