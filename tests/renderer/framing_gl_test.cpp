// Pictures of cameras that frame the scene by themselves: what is seen lies in the middle, with an even margin.
#include <cmath>

#include "tests/renderer/frame_fixture.h"

namespace gnomon {
namespace {

using testing::floatsOf;
using testing::GlbBuilder;
using testing::renderJson;
using testing::sceneOf;

constexpr int kSide = 256;

/// Pixels of the picture beside what is seen.
struct Margins {
  int left = kSide, right = kSide, top = kSide, bottom = kSide;
};

Margins marginsOf(const ScenePtr& scene, Json spec) {
  spec["width"] = kSide;
  spec["height"] = kSide;
  spec["views"] = {"depth"};
  spec["antialiasing"] = "none";
  spec["lights"] = Json::array();
  spec["output"] = {{"format", "exr"}, {"exrPixelType", "float"}};
  const Frame frame = renderJson(scene, spec.dump());
  const std::vector<float>& depths = floatsOf(frame);
  Margins margins;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      if (!std::isfinite(depths[static_cast<std::size_t>(y * kSide + x)])) continue;
      margins.left = std::min(margins.left, x);
      margins.right = std::min(margins.right, kSide - 1 - x);
      margins.top = std::min(margins.top, y);
      margins.bottom = std::min(margins.bottom, kSide - 1 - y);
    }
  }
  return margins;
}

/// What is seen lies in the middle, and one pair of sides has the margin of a fortieth.
void expectFramed(const Margins& margins, const char* what) {
  EXPECT_NEAR(margins.left, margins.right, 1) << what;
  EXPECT_NEAR(margins.top, margins.bottom, 1) << what;
  EXPECT_NEAR(std::min(margins.left, margins.top), kSide / 40.0, 1.5) << what;
}

TEST(Framing, ABoxLiesInTheMiddleFromEveryDirection) {
  const ScenePtr scene = sceneOf(testing::cube());
  expectFramed(marginsOf(scene, Json::object()), "the default");
  for (const auto& [azimuth, elevation] : {std::pair{0, 0}, {30, 60}, {100, -20}, {200, 90}}) {
    const Json orbit{{"azimuthDegrees", azimuth}, {"elevationDegrees", elevation}};
    expectFramed(marginsOf(scene, {{"camera", {{"orbit", orbit}}}}), "an orbit");
  }
  expectFramed(marginsOf(scene, {{"camera", {{"perspective", {{"fovYDegrees", 100}}}}}}), "a wide lens");
}

TEST(Framing, WhatIsHiddenDoesNotCount) {
  GlbBuilder builder = testing::cube();
  builder.addRoot({{"mesh", 0}, {"name", "far"}, {"translation", {40, 10, 0}}});
  const ScenePtr scene = sceneOf(builder);
  const Json hidden{{"nodes", {{{"node", "far"}, {"visible", false}}}}};
  expectFramed(marginsOf(scene, hidden), "hidden");
  expectFramed(marginsOf(scene, Json::object()), "seen");
}

TEST(Framing, VerticesCountWhereTheyArePosed) {
  GlbBuilder builder = testing::cube();
  const int moved = builder.addPoints(std::vector<testing::Point>(24, {9, 0, 0}));
  builder.json["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", moved}}};
  builder.json["meshes"][0]["weights"] = {0};
  builder.addRoot({{"mesh", 0}, {"translation", {0, 0, -6}}});
  const int times = builder.addAccessor(std::vector<float>{0, 1}, "SCALAR", 5126, 2);
  const int weights = builder.addAccessor(std::vector<float>{0, 1}, "SCALAR", 5126, 2);
  builder.add("animations", {{"samplers", {{{"input", times}, {"output", weights}}}},
                             {"channels", {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "weights"}}}}}}});
  const ScenePtr scene = sceneOf(builder);
  for (const double seconds : {0.0, 0.5, 1.0}) {
    expectFramed(marginsOf(scene, {{"animation", {{"index", 0}, {"timeSeconds", seconds}}}}), "morphed");
  }
}

} // namespace
} // namespace gnomon
