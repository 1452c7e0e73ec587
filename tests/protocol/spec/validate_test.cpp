#include "protocol/spec/validate.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include "tests/protocol/found_problems.h"
#include "tests/protocol/spec_generator.h"

namespace gnomon {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

std::vector<std::string> wrongIn(const FrameSpec& spec) {
  return pointersOf(validate(spec));
}

std::vector<std::string> wrongIn(const Light& light) {
  FrameSpec spec;
  spec.lights = std::vector{Light{.sun = Sun{}}, light};
  return wrongIn(spec);
}

std::vector<std::string> wrongIn(const Camera& camera) {
  FrameSpec spec;
  spec.camera = camera;
  return wrongIn(spec);
}

std::vector<std::string> wrongIn(const Shadow& shadow) {
  FrameSpec spec;
  spec.shadow = shadow;
  return wrongIn(spec);
}

TEST(Validate, AWebpHasShorterSides) {
  FrameSpec spec;
  spec.width = 16384;
  spec.height = 16;
  EXPECT_THAT(wrongIn(spec), IsEmpty());
  spec.output.format = ImageFormat::webp;
  EXPECT_THAT(wrongIn(spec), ElementsAre("/width"));
  spec.width = 16383;
  EXPECT_THAT(wrongIn(spec), IsEmpty());
}

TEST(Validate, TheDefaultsAreGood) {
  EXPECT_THAT(wrongIn(FrameSpec{}), IsEmpty());
}

TEST(Validate, EveryGeneratedSpecIsGood) {
  EXPECT_TRUE(rc::check([] {
    const FrameSpec spec = *anySpec();
    const Problems problems = validate(spec);
    if (!problems.empty()) RC_FAIL(problems[0].pointer + ": " + problems[0].detail);
  }));
}

TEST(Validate, HoldsEveryValueAgainstItsRow) {
  FrameSpec spec;
  spec.width = 0;
  spec.exposure = std::nan("");
  spec.background.color[1] = std::numeric_limits<double>::infinity();
  spec.views = {};
  spec.shadow.filter.size = 6;
  spec.camera.fit = false;
  spec.camera.node = std::string("\xFF");
  spec.lights = std::vector<Light>(257, Light{.sun = Sun{}});
  spec.toneMapping = static_cast<ToneMapping>(7);
  EXPECT_THAT(wrongIn(spec), ElementsAre("/width", "/camera/node", "/camera/fit", "/lights", "/shadow/filter/size",
                                         "/background/color/1", "/exposure", "/toneMapping", "/views"));
}

TEST(Validate, AFrameHasOnlySoManyPixels) {
  FrameSpec spec;
  spec.width = 8192;
  spec.height = 4096;
  EXPECT_THAT(wrongIn(spec), IsEmpty());
  spec.height = 4097;
  ASSERT_THAT(wrongIn(spec), ElementsAre("/width"));
  EXPECT_EQ(validate(spec)[0].code, ProblemCode::tooLarge);
}

TEST(Validate, EveryFurtherPlacementOfACameraIsTold) {
  EXPECT_THAT(wrongIn(Camera{.lookAt = EyeTarget{}, .orbit = Orbit{}, .node = 1, .fit = true}),
              ElementsAre("/camera/orbit", "/camera/node", "/camera/fit"));
}

TEST(Validate, AnAnimationHasOneNameOrIndex) {
  FrameSpec spec;
  spec.animation = AnimationMoment{.index = 1, .name = "Walk"};
  EXPECT_THAT(wrongIn(spec), ElementsAre("/animation/name"));
}

std::vector<std::string> wrongIn(const NodeOptions& node) {
  FrameSpec spec;
  spec.nodes = {node};
  return wrongIn(spec);
}

TEST(Validate, ANodeHasAMatrixOrPartsOfAPlace) {
  NodeOptions node;
  node.node = 0;
  node.matrix = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  EXPECT_THAT(wrongIn(node), IsEmpty());
  (*node.matrix)[7] = 0.5;
  EXPECT_THAT(wrongIn(node), ElementsAre("/nodes/0/matrix"));
  (*node.matrix)[7] = 0;
  node.scale = Vec3{1, 1, 1};
  EXPECT_THAT(wrongIn(node), ElementsAre("/nodes/0/matrix"));
  node.matrix.reset();
  node.scale = Vec3{0, 0, 0};
  node.rotation = {0, 0, 0, 1e-3};
  EXPECT_THAT(wrongIn(node), IsEmpty());
}

TEST(Validate, ACameraLooksSomewhere) {
  EXPECT_THAT(wrongIn(Camera{.lookAt = EyeTarget{{1, 2, 3}, {1, 2, 3}, {0, 1, 0}}}), ElementsAre("/camera/target"));
  EXPECT_THAT(wrongIn(Camera{.lookAt = EyeTarget{{0, 0, 5}, {0, 0, 0}, {0, 0, 0}}}), ElementsAre("/camera/up"));
  EXPECT_THAT(wrongIn(Camera{.lookAt = EyeTarget{{0, 5, 0}, {0, 0, 0}, {0, 1, 0}}}), ElementsAre("/camera/up"));
  EXPECT_THAT(wrongIn(Camera{.lookAt = EyeTarget{{0, 5, 0}, {0, 0, 0}, {0, -1e9, 0}}}), ElementsAre("/camera/up"));
  EXPECT_THAT(wrongIn(Camera{.lookAt = EyeTarget{{0, 5, 0}, {0, 0, 0}, {0, 1, 0.001}}}), IsEmpty());
}

TEST(Validate, APoseIsARotationAndATranslation) {
  const auto wrong = [](const Rows4& rows) { return wrongIn(Camera{.pose = CameraPose{rows, CameraAxes::opencv}}); };
  const double c = std::cos(0.4), s = std::sin(0.4), nan = std::numeric_limits<double>::quiet_NaN();
  const std::string matrix = "/camera/pose/worldFromCamera";
  EXPECT_THAT(wrong({{{c, -s, 0, 7}, {s, c, 0, -8e8}, {0, 0, 1, 9}, {0, 0, 0, 1}}}), IsEmpty());
  EXPECT_THAT(wrong({{{0.921, -0.389, 0, 7}, {0.389, 0.921, 0, 8}, {0, 0, 1, 9}, {0, 0, 0, 1}}}), IsEmpty())
      << "rounded";
  EXPECT_THAT(wrong({{{1, 0.01, 0, 7}, {0, 1, 0, 8}, {0, 0, 1, 9}, {0, 0, 0, 1}}}), ElementsAre(matrix)) << "sheared";
  EXPECT_THAT(wrong(Rows4{{{}, {}, {}, {0, 0, 0, 1}}}), ElementsAre(matrix)) << "zero";
  EXPECT_THAT(wrong({{{nan, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}}), ElementsAre(matrix + "/0/0"));
  EXPECT_THAT(wrong({{{1, 0, 0, 0}, {0, 1, 0, 2e9}, {0, 0, 1, 0}, {0, 0, 0, 1}}}), ElementsAre(matrix + "/1/3"));
}

TEST(Validate, NearLiesBeforeFar) {
  EXPECT_THAT(wrongIn(Camera{.intrinsics = Intrinsics{.near = 5, .far = 5}}), ElementsAre("/camera/intrinsics/far"));
  EXPECT_THAT(wrongIn(Camera{.perspective = Perspective{45, 5, 5}}), ElementsAre("/camera/perspective/far"));
  EXPECT_THAT(wrongIn(Camera{.perspective = Perspective{45, 5, std::nullopt}}), IsEmpty());
  EXPECT_THAT(wrongIn(Camera{.orthographic = Orthographic{10, 5, -5}}), ElementsAre("/camera/orthographic/far"));
  EXPECT_THAT(wrongIn(Camera{.orthographic = Orthographic{10, -5, 5}}), IsEmpty());
}

TEST(Validate, ADirectionalLightNeedsOneDirection) {
  EXPECT_THAT(wrongIn(Light{}), ElementsAre("/lights/1/direction"));
  EXPECT_THAT(wrongIn(Light{.direction = Vec3{0, -1, 0}}), IsEmpty());
  EXPECT_THAT(wrongIn(Light{.sun = Sun{}, .position = Vec3{}, .range = 3}),
              ElementsAre("/lights/1/position", "/lights/1/range"));
}

TEST(Validate, SpotAndPointHaveAPlace) {
  EXPECT_THAT(wrongIn(Light{.type = LightType::spot, .direction = Vec3{0, -1, 0}, .position = Vec3{}}), IsEmpty());
  EXPECT_THAT(wrongIn(Light{.type = LightType::spot}), ElementsAre("/lights/1/direction", "/lights/1/position"));
  EXPECT_THAT(wrongIn(Light{.type = LightType::point, .position = Vec3{}}), IsEmpty());
  EXPECT_THAT(wrongIn(Light{.type = LightType::point}), ElementsAre("/lights/1/position"));
  EXPECT_THAT(wrongIn(Light{.type = LightType::point, .direction = Vec3{0, -1, 0}, .position = Vec3{}}),
              ElementsAre("/lights/1/direction"));
  EXPECT_THAT(wrongIn(Light{.type = LightType::point, .sun = Sun{}, .position = Vec3{}, .shadow = Shadow{}}),
              ElementsAre("/lights/1/sun"));
}

TEST(Validate, TheInnerConeIsTheNarrower) {
  Light light{.type = LightType::spot, .direction = Vec3{0, -1, 0}, .position = Vec3{}};
  light.innerConeDegrees = light.outerConeDegrees = 30;
  EXPECT_THAT(wrongIn(light), ElementsAre("/lights/1/innerConeDegrees"));
}

TEST(Validate, OnlySpotsHaveCones) {
  const Light sun{.sun = Sun{}}, point{.type = LightType::point, .position = Vec3{}};
  for (Light light : {sun, point}) {
    EXPECT_THAT(wrongIn(light), IsEmpty()) << "the defaults, as they are echoed";
    light.outerConeDegrees = 30;
    EXPECT_THAT(wrongIn(light), ElementsAre("/lights/1/outerConeDegrees"));
    light.innerConeDegrees = 20;
    EXPECT_THAT(wrongIn(light), UnorderedElementsAre("/lights/1/innerConeDegrees", "/lights/1/outerConeDegrees"));
  }
}

TEST(Validate, SplitsBelongToAManualPartition) {
  Shadow shadow;
  shadow.cascadeCount = 3;
  shadow.partition.splits = {0.1, 0.2, 1};
  EXPECT_THAT(wrongIn(shadow), ElementsAre("/shadow/partition/splits"));
  shadow.partition.mode = PartitionMode::manual;
  EXPECT_THAT(wrongIn(shadow), IsEmpty());
  shadow.partition.splits = {0.1, 1};
  EXPECT_THAT(wrongIn(shadow), ElementsAre("/shadow/partition/splits"));
  shadow.partition.splits = {0.3, 0.3, 0.2};
  EXPECT_THAT(wrongIn(shadow), ElementsAre("/shadow/partition/splits/1", "/shadow/partition/splits/2"));
  shadow.partition.splits = {0.1, 0.2, 1.01};
  EXPECT_THAT(wrongIn(shadow), ElementsAre("/shadow/partition/splits/2"));
}

TEST(Validate, MinAndMaxBelongToAManualDepthRange) {
  Shadow shadow;
  shadow.depthRange = {DepthRangeMode::automatic, 1, std::nullopt};
  EXPECT_THAT(wrongIn(shadow), ElementsAre("/shadow/depthRange/min"));
  shadow.depthRange = {DepthRangeMode::manual, std::nullopt, 5};
  EXPECT_THAT(wrongIn(shadow), ElementsAre("/shadow/depthRange/min"));
  shadow.depthRange = {DepthRangeMode::manual, 0, 5};
  EXPECT_THAT(wrongIn(shadow), IsEmpty());
}

TEST(Validate, ALightsOwnShadowIsHeldToTheSameRules) {
  Light light{.sun = Sun{}, .shadow = Shadow{}};
  light.shadow->depthRange.max = 5;
  EXPECT_THAT(wrongIn(light), ElementsAre("/lights/1/shadow/depthRange/max"));
}

TEST(Validate, NoValueOfATransferFunctionComesTwice) {
  FrameSpec spec;
  spec.volumes = {{.file = "a.npy", .box = VolumeBox{}, .transferFunction = {{.value = 1}, {.value = 1}}}};
  EXPECT_THAT(wrongIn(spec), ElementsAre("/volumes/0/transferFunction/1/value"));
}

TEST(Validate, AnEnvironmentIsOneOfAFileASkyAndALight) {
  FrameSpec spec;
  spec.environment.file = "a.hdr";
  EXPECT_THAT(wrongIn(spec), IsEmpty());
  spec.environment.sky.emplace();
  EXPECT_THAT(wrongIn(spec), ElementsAre("/environment"));
  spec.environment.file.reset();
  spec.environment.light = 0;
  EXPECT_THAT(wrongIn(spec), ElementsAre("/environment"));
  spec.environment.sky.reset();
  EXPECT_THAT(wrongIn(spec), IsEmpty());
}

TEST(Validate, ATileFitsTheAtlas) {
  FrameSpec spec;
  spec.atlas = {512, 1024};
  EXPECT_THAT(wrongIn(spec), ElementsAre("/atlas/baseSize"));
  spec.atlas = {1024, 1024};
  EXPECT_THAT(wrongIn(spec), IsEmpty());
  spec.shadow.size = ShadowSize::XLarge;
  spec.atlas.size = 2048;
  EXPECT_THAT(wrongIn(spec), IsEmpty());
}

TEST(Validate, ATileDoublesWithEachSize) {
  const Atlas atlas{8192, 1024};
  EXPECT_EQ(tileSide(ShadowSize::XSmall, atlas), 128);
  EXPECT_EQ(tileSide(ShadowSize::Small, atlas), 256);
  EXPECT_EQ(tileSide(ShadowSize::Medium, atlas), 512);
  EXPECT_EQ(tileSide(ShadowSize::Large, atlas), 1024);
  EXPECT_EQ(tileSide(ShadowSize::XLarge, atlas), 2048);
}

} // namespace
} // namespace gnomon
