#include <limits>

#include "renderer/scene/animation/motion.h"
#include "tests/renderer/scene/animation/animated.h"
#include "tests/renderer/scene/load.h"

namespace gnomon {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

testing::GlbBuilder moved(const std::vector<float>& times, const std::vector<float>& values, const char* path,
                          const char* type, const char* interpolation = "LINEAR") {
  testing::GlbBuilder builder = testing::cube();
  animate(builder, 0, path, times, values, type, interpolation);
  return builder;
}

/// The channel with this fault is left out, and the file refused where it has to conform.
void expectLeftOut(const testing::GlbBuilder& builder, const char* pointer) {
  const Scene scene = load(builder);
  EXPECT_THAT(scene.summary.warnings, Contains(AllOf(HasSubstr("left out"), HasSubstr(pointer))));
  std::size_t channels = 0;
  for (const json& animation : builder.json["animations"]) channels += animation["channels"].size();
  std::size_t kept = 0;
  for (const Animation& each : scene.motion->animations) kept += each.channels.size() + each.properties.size();
  EXPECT_EQ(kept, channels - 1) << pointer;
  SceneBundle strict = builder.bundle();
  strict.strict = true;
  EXPECT_THAT(problemsOf(strict), Contains(ProblemAt(ProblemCode::invalidScene, pointer)));
}

TEST(Animations, AreListedWithNameAndDuration) {
  testing::GlbBuilder builder = moved({0, 2.5f}, {0, 0, 0, 1, 1, 1}, "translation", "VEC3");
  builder.add("animations", {{"channels", json::array()}, {"samplers", json::array()}});
  const SceneSummary summary = load(builder).summary;
  ASSERT_EQ(summary.animations.size(), 2u);
  EXPECT_EQ(summary.animations[0].name, "Move");
  EXPECT_EQ(summary.animations[0].durationSeconds, 2.5);
  EXPECT_EQ(summary.animations[1].durationSeconds, 0);
  EXPECT_THAT(summary.warnings, ElementsAre(HasSubstr("/animations/1/channels")));
}

TEST(Animations, TimesAreFiniteAndIncrease) {
  for (const auto& times : std::vector<std::vector<float>>{{1, 1}, {2, 1}, {0, kNan}, {0, kInfinity}, {-1, 0}}) {
    expectLeftOut(moved(times, {0, 0, 0, 1, 1, 1}, "translation", "VEC3"), "/animations/0/samplers/0/input");
  }
}

TEST(Animations, ValuesAreFiniteAndAsManyAsTheKeyframesTake) {
  const char* output = "/animations/0/samplers/0/output";
  expectLeftOut(moved({0, 1}, {0, 0, 0, 1, kNan, 1}, "translation", "VEC3"), output);
  expectLeftOut(moved({0, 1}, {0, 0, 0}, "scale", "VEC3"), output);
  expectLeftOut(moved({0, 1}, {0, 0, 0, 1, 1, 1}, "scale", "VEC3", "CUBICSPLINE"), output);
  expectLeftOut(moved({0, 1}, {0, 0, 0, 1, 1, 1}, "rotation", "VEC3"), output);
  expectLeftOut(moved({0, 1}, {0, 0, 0, 0, 0, 0, 0, 1}, "rotation", "VEC4"), output);
}

TEST(Animations, ACubicSplineNeedsTwoKeyframes) {
  expectLeftOut(moved({0}, std::vector<float>(9), "scale", "VEC3", "CUBICSPLINE"), "/animations/0/samplers/0/input");
}

TEST(Animations, InterpolationIsOneOfThree) {
  expectLeftOut(moved({0, 1}, {0, 0, 0, 1, 1, 1}, "scale", "VEC3", "QUINTIC"),
                "/animations/0/samplers/0/interpolation");
}

TEST(Animations, ChannelsMoveWhatTheNodeHasAndNothingTwice) {
  const char* target = "/animations/0/channels/0/target";
  testing::GlbBuilder fixed = moved({0, 1}, {0, 0, 0, 1, 1, 1}, "scale", "VEC3");
  fixed.json["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  expectLeftOut(fixed, target);
  expectLeftOut(moved({0, 1}, {0, 1}, "weights", "SCALAR"), target);
  testing::GlbBuilder twice = moved({0, 1}, {0, 0, 0, 1, 1, 1}, "scale", "VEC3");
  animate(twice, 0, "scale", {0, 1}, {0, 0, 0, 1, 1, 1}, "VEC3");
  expectLeftOut(twice, "/animations/0/channels/1/target");
}

TEST(Animations, KeyframesAreLimited) {
  const testing::GlbBuilder builder = moved({0, 1}, {0, 0, 0, 1, 1, 1}, "translation", "VEC3");
  expectLimit(builder, &Limits::maxKeyframes, 8, "/animations/0/samplers/0"); // two times and six numbers
  expectBeyond(builder, &Limits::maxAnimations, 0, "/animations");
}

TEST(Animations, PointersToNodesAreChannelsAndOthersAreTold) {
  testing::GlbBuilder builder = moved({0, 1}, {0, 0, 0, 1, 1, 1}, "translation", "VEC3");
  builder.json["extensionsUsed"] = {"KHR_animation_pointer"};
  json& channels = builder.json["animations"][0]["channels"];
  const auto pointTo = [&](const char* pointer) { channels[0]["target"] = pointerTarget(pointer); };
  pointTo("/nodes/0/translation");
  EXPECT_EQ(load(builder).summary.animations[0].durationSeconds, 1);
  EXPECT_THAT(load(builder).summary.warnings, IsEmpty());
  for (const char* other : {"/materials/0/emissiveFactor", "/nodes/1/scale", "/nodes/00/scale", "/nodes/0", "/nodes/",
                            "/nodes/0/", "/nodes/-1/scale", ""}) {
    pointTo(other);
    const SceneSummary summary = load(builder).summary;
    EXPECT_EQ(summary.animations[0].durationSeconds, 0) << other;
    EXPECT_THAT(summary.warnings, ElementsAre(HasSubstr("is ignored"))) << other;
  }
}

TEST(Animations, KeyframesOfAPropertyLieInItsRange) {
  testing::GlbBuilder builder = testing::cube();
  builder.add("materials", json::object());
  animatePointer(builder, "/materials/0/pbrMetallicRoughness/roughnessFactor", {0, 1}, {0.5f, 1.5f}, "SCALAR");
  expectLeftOut(builder, "/animations/0/samplers/0/output");
  // Only the middle row of a spline is values; its tangents may be any.
  testing::GlbBuilder spline = testing::cube();
  spline.add("materials", json::object());
  animatePointer(spline, "/materials/0/pbrMetallicRoughness/roughnessFactor", {0, 1}, {-9, 0.5f, 9, -9, 1, 9}, "SCALAR",
                 "CUBICSPLINE");
  EXPECT_THAT(problemsOf(spline), IsEmpty());
}

TEST(Animations, APropertyIsMovedOnceAndByValuesOfItsSize) {
  testing::GlbBuilder builder = testing::cube();
  builder.add("materials", json::object());
  animatePointer(builder, "/materials/0/emissiveFactor", {0, 1}, {0, 0, 0, 1, 1, 1}, "VEC3");
  testing::GlbBuilder twice = builder;
  animatePointer(twice, "/materials/0/emissiveFactor", {0, 1}, {0, 0, 0, 1, 1, 1}, "VEC3");
  expectLeftOut(twice, "/animations/0/channels/1/target");
  testing::GlbBuilder narrow = testing::cube();
  narrow.add("materials", json::object());
  animatePointer(narrow, "/materials/0/emissiveFactor", {0, 1}, {0, 1}, "SCALAR");
  expectLeftOut(narrow, "/animations/0/samplers/0/output");
}

TEST(Animations, VisibilityChangesInStepsOfBytes) {
  const auto blinking = [](const std::vector<std::uint8_t>& values, const char* interpolation) {
    testing::GlbBuilder builder = testing::cube();
    addChannel(builder, pointerTarget("/nodes/0/extensions/KHR_node_visibility/visible"), {0, 1},
               builder.addAccessor(values, "SCALAR", 5121, values.size()), interpolation);
    return builder;
  };
  EXPECT_THAT(problemsOf(blinking({1, 0}, "STEP")), IsEmpty());
  expectLeftOut(blinking({1, 0}, "LINEAR"), "/animations/0/samplers/0/interpolation");
  testing::GlbBuilder floats = testing::cube();
  animatePointer(floats, "/nodes/0/extensions/KHR_node_visibility/visible", {0, 1}, {1, 0}, "SCALAR", "STEP");
  expectLeftOut(floats, "/animations/0/samplers/0/output");
}

} // namespace
} // namespace gnomon
