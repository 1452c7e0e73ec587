// View motion of whole frames, held against what can be worked out without it.
#include <cmath>

#include "tests/renderer/frame_fixture.h"
#include "tests/renderer/scene/animation/animated.h"

namespace gnomon {
namespace {

using testing::floatsOf;
using testing::renderJson;
using testing::sceneOf;

constexpr int kSide = 100;

/// Straight down on 10 m, 10 pixels a metre, -Z upwards.
Json fromAbove(const Json& patch) {
  Json spec{
      {"width", kSide},
      {"height", kSide},
      {"camera", {{"eye", {0, 8, 0}}, {"target", {0, 0, 0}}, {"up", {0, 0, -1}}, {"orthographic", {{"height", 10}}}}},
      {"lights", Json::array()},
      {"views", {"motion"}},
      {"output", {{"format", "exr"}}}};
  spec.merge_patch(patch);
  return spec;
}

/// A plate of 2 m by 2 m, node 0.
testing::GlbBuilder plate() {
  return testing::plane();
}

/// At a place of the ground, metres.
glm::vec2 motionAt(const Frame& frame, double x, double z) {
  const auto pixel = static_cast<std::size_t>((z + 5) * 10) * kSide + static_cast<std::size_t>((x + 5) * 10);
  const auto& pixels = floatsOf(frame);
  return {pixels[2 * pixel], pixels[2 * pixel + 1]};
}

void expectNear(const glm::vec2& motion, double x, double y) {
  EXPECT_NEAR(motion.x, x, 1e-4);
  EXPECT_NEAR(motion.y, y, 1e-4);
}

Frame motionOf(const testing::GlbBuilder& builder, const Json& patch) {
  return renderJson(sceneOf(builder), fromAbove(patch).dump());
}

TEST(MotionFrames, NothingMovesExactlyNowhere) {
  const Frame frame = motionOf(plate(), {{"motionFrom", Json::object()}});
  EXPECT_EQ(frame.images[0].image.channels, (std::vector<std::string>{"X", "Y"}));
  std::size_t still = 0;
  for (const float number : floatsOf(frame)) {
    EXPECT_TRUE(number == 0 || std::isinf(number));
    still += number == 0 ? 1 : 0;
  }
  EXPECT_EQ(still, 2u * 20 * 20);
}

TEST(MotionFrames, AMovedNodeCarriesItsPixels) {
  const Frame frame = motionOf(plate(), {{"nodes", {{{"node", 0}, {"translation", {1, 0, -2}}}}},
                                         {"motionFrom", {{"nodes", {{{"node", 0}, {"translation", {0.5, 0, 1}}}}}}}});
  expectNear(motionAt(frame, 1, -2), 5, -30);
  EXPECT_TRUE(std::isinf(motionAt(frame, -4, 4).x));
}

TEST(MotionFrames, WithoutNodesThePlacesAreThoseOfTheFrame) {
  const Frame frame =
      motionOf(plate(), {{"nodes", {{{"node", 0}, {"translation", {1, 0, -2}}}}}, {"motionFrom", Json::object()}});
  EXPECT_EQ(motionAt(frame, 1, -2), glm::vec2(0));
}

TEST(MotionFrames, ACameraThatMovesShiftsThePlaneTheOtherWay) {
  const Frame frame = motionOf(
      plate(),
      {{"motionFrom",
        {{"camera",
          {{"eye", {-1, 8, 0}}, {"target", {-1, 0, 0}}, {"up", {0, 0, -1}}, {"orthographic", {{"height", 10}}}}}}}});
  expectNear(motionAt(frame, 0, 0), -10, 0);

  const Json lens{{"fovYDegrees", 90}};
  const Json now{{"eye", {0, 5, 0}}, {"target", {0, 0, 0}}, {"up", {0, 0, -1}}, {"perspective", lens}};
  const Json then{{"eye", {0.5, 5, 0.25}}, {"target", {0.5, 0, 0.25}}, {"up", {0, 0, -1}}, {"perspective", lens}};
  Json spec = fromAbove({{"motionFrom", {{"camera", then}}}});
  spec["camera"] = now;
  expectNear(motionAt(renderJson(sceneOf(plate()), spec.dump()), 0, 0), 5, 2.5);
}

TEST(MotionFrames, WhatWasNotThereHasNoMotion) {
  testing::GlbBuilder builder = plate();
  builder.json["extensionsUsed"] = {"KHR_animation_pointer", "KHR_node_visibility"};
  const int values = builder.addAccessor(std::vector<std::uint8_t>{0, 1}, "SCALAR", 5121, 2);
  addChannel(builder, pointerTarget("/nodes/0/extensions/KHR_node_visibility/visible"), {0, 1}, values, "STEP");
  const Json now{{"index", 0}, {"timeSeconds", 1}};
  const Frame frame = motionOf(builder, {{"animation", now}, {"motionFrom", {{"animation", {{"index", 0}}}}}});
  EXPECT_TRUE(std::isinf(motionAt(frame, 0, 0).x));
  const Frame rest = motionOf(builder, {{"animation", now}, {"motionFrom", {{"animation", Json::object()}}}});
  EXPECT_EQ(motionAt(rest, 0, 0), glm::vec2(0)) << "the file itself shows it";
}

TEST(MotionFrames, MorphedVerticesCarryTheirTriangles) {
  testing::GlbBuilder builder = plate();
  const int moves = builder.addPoints(std::vector<testing::Point>(4, {2, 0, 0}));
  builder.json["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", moves}}};
  animate(builder, 0, "weights", {0, 2}, {0, 1}, "SCALAR");
  const auto at = [](double seconds) { return Json{{"index", 0}, {"timeSeconds", seconds}}; };
  const Frame frame = motionOf(builder, {{"animation", at(1)}, {"motionFrom", {{"animation", at(0.5)}}}});
  expectNear(motionAt(frame, 1, 0), 5, 0);
}

TEST(MotionFrames, TheEffectiveSpecGivesTheSameAgain) {
  Json spec = fromAbove({{"motionFrom", {{"nodes", {{{"node", 0}, {"scale", {3, 1, 3}}}}}}}});
  spec["camera"] = {{"orbit", {{"azimuthDegrees", 30}, {"elevationDegrees", 40}}}};
  const ScenePtr scene = sceneOf(plate());
  const Frame first = renderJson(scene, spec.dump());
  const Frame second = renderJson(scene, toJson(first.report.spec).dump());
  EXPECT_EQ(floatsOf(first), floatsOf(second));
  EXPECT_TRUE(first.report.spec.motionFrom->camera->lookAt);
}

TEST(MotionFrames, ACameraThatIsFittedToTheSceneStandsStillWhenANodeMoves) {
  testing::GlbBuilder builder = plate();
  builder.addMeshNode(0);
  Json spec = fromAbove({{"motionFrom", {{"nodes", {{{"node", 1}, {"translation", {30, 0, 40}}}}}}}});
  spec["camera"] = {{"orbit", {{"azimuthDegrees", 180}, {"elevationDegrees", 90}}}};
  const Frame frame = renderJson(sceneOf(builder), spec.dump());
  std::size_t still = 0;
  for (const float number : floatsOf(frame)) still += number == 0 ? 1 : 0;
  EXPECT_GT(still, 1'000u);
}

} // namespace
} // namespace gnomon
