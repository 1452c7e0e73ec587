#include "clients/cli/spec/spec_arguments.h"

#include <cmath>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <rapidcheck.h>

#include "protocol/json/json_codec.h"

namespace gnomon::cli {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

FrameSpec resolved(const std::string& spec, const SpecArguments& arguments) {
  auto result = resolveSpec(spec, arguments).spec;
  if (!result) {
    ADD_FAILURE() << problemLine(result.problems().front());
    return {};
  }
  return *result;
}

Problems refused(const std::string& spec, const SpecArguments& arguments) {
  auto result = resolveSpec(spec, arguments).spec;
  return result ? Problems() : result.problems();
}

TEST(SpecArguments, NoFlagsAreTheDefaults) {
  EXPECT_EQ(toJson(resolved("{}", {})), toJson(FrameSpec{}));
}

TEST(SpecArguments, FlagsGoOverTheSpec) {
  SpecArguments flags;
  flags.width = 320;
  flags.views = {"depth", "normal"};
  flags.format = "exr";
  const FrameSpec spec = resolved(R"({"width": 64, "height": 48, "views": ["shadow"]})", flags);
  EXPECT_EQ(spec.width, 320);
  EXPECT_EQ(spec.height, 48);
  EXPECT_THAT(spec.views, ElementsAre(View::depth, View::normal));
  EXPECT_EQ(spec.output.format, ImageFormat::exr);
}

TEST(SpecArguments, SunWithoutLightsIsTheOnlyLight) {
  SpecArguments flags;
  flags.sun = {135, 40};
  const FrameSpec spec = resolved("{}", flags);
  EXPECT_EQ(toJson(spec), toJson(*decodeFrameQuery({{"sun", "135,40"}})));
}

TEST(SpecArguments, SunTurnsTheFirstDirectionalLightAndKeepsTheRest) {
  SpecArguments flags;
  flags.sun = {90, 10};
  const FrameSpec spec = resolved(
      R"({"lights": [{"type": "point", "position": [0, 1, 0]},
                     {"type": "directional", "direction": [0, -1, 0], "intensity": 7}]})",
      flags);
  ASSERT_TRUE(spec.lights);
  ASSERT_EQ(spec.lights->size(), 2u);
  const Light& sun = spec.lights->at(1);
  EXPECT_FALSE(sun.direction);
  ASSERT_TRUE(sun.sun);
  EXPECT_EQ(sun.sun->azimuthDegrees, 90);
  EXPECT_EQ(sun.intensity, 7);
}

TEST(SpecArguments, SunIsAddedWhereNoLightIsDirectional) {
  SpecArguments flags;
  flags.sun = {90, 10};
  const FrameSpec spec = resolved(R"({"lights": [{"type": "point", "position": [0, 1, 0]}]})", flags);
  ASSERT_EQ(spec.lights->size(), 2u);
  EXPECT_EQ(spec.lights->at(1).type, LightType::directional);
}

TEST(SpecArguments, AnEnvironmentTakesThePlaceOfAnotherAndKeepsHowItIsShown) {
  SpecArguments flags;
  flags.environment = "lights/studio.hdr";
  const FrameSpec file = resolved(R"({"environment": {"sky": {"turbidity": 4}, "background": "blurred"}})", flags);
  EXPECT_EQ(file.environment.file, "studio.hdr");
  EXPECT_FALSE(file.environment.sky);
  EXPECT_EQ(file.environment.background, EnvironmentBackground::blurred);
  flags.environment = "sky";
  const FrameSpec sky = resolved(R"({"environment": {"file": "a.hdr", "rotationDegrees": 30}})", flags);
  EXPECT_FALSE(sky.environment.file);
  ASSERT_TRUE(sky.environment.sky);
  EXPECT_EQ(sky.environment.rotationDegrees, 30);
  EXPECT_EQ(resolved(R"({"environment": {"sky": {"turbidity": 4}}})", flags).environment.sky->turbidity, 4);
  flags.environment = "studio";
  const FrameSpec studio = resolved(R"({"environment": {"file": "a.hdr", "intensity": 2}})", flags);
  EXPECT_FALSE(studio.environment.file || studio.environment.sky);
  EXPECT_EQ(studio.environment.intensity, 2);
  EXPECT_EQ(studio.environment.studio, Studio::lamps) << "named, so that the glTF's own light is not asked for";
  const FrameSpec even = resolved(R"({"environment": {"light": 1, "studio": "even"}})", flags);
  EXPECT_FALSE(even.environment.light);
  EXPECT_EQ(even.environment.studio, Studio::even);
}

TEST(SpecArguments, TheSunIsThatOfTheSkyWhereThereIsOne) {
  SpecArguments flags;
  flags.sun = {90, 10};
  flags.environment = "sky";
  const ResolvedSpec sky = resolveSpec("{}", flags);
  ASSERT_TRUE(sky.spec);
  EXPECT_EQ(sky.spec->environment.sky->sun.elevationDegrees, 10);
  EXPECT_FALSE(sky.spec->lights);
  EXPECT_EQ(sky.origins.at("/environment/sky/sun"), "--sun");
  EXPECT_EQ(sky.origins.at("/environment/sky"), "--environment");
}

TEST(SpecArguments, AnEnvironmentIsAPictureOrAWord) {
  for (const char* text : {"a.hdr", "/b/c.EXR", "sky", "studio"}) EXPECT_EQ(checkEnvironment(text), "") << text;
  for (const char* text : {"", "a.png", "skies", "hdr", "sky.glb"}) {
    EXPECT_THAT(checkEnvironment(text), HasSubstr(".hdr or .exr")) << text;
  }
}

TEST(SpecArguments, CameraIsAnIndexWhenItIsANumber) {
  SpecArguments flags;
  flags.camera = "12";
  EXPECT_EQ(std::get<std::string>(*resolved("{}", flags).camera.node), "12"); // names come first
  flags.camera = "Gallery 2";
  EXPECT_EQ(std::get<std::string>(*resolved("{}", flags).camera.node), "Gallery 2");
}

TEST(SpecArguments, OrbitReplacesThePlacementAndKeepsTheLens) {
  SpecArguments flags;
  flags.orbit = {30, 20, 5};
  const FrameSpec spec =
      resolved(R"({"camera": {"eye": [0, 0, 9], "target": [0, 0, 0], "perspective": {"fovYDegrees": 30}}})", flags);
  EXPECT_FALSE(spec.camera.lookAt);
  ASSERT_TRUE(spec.camera.orbit);
  EXPECT_EQ(spec.camera.orbit->distance, 5);
  ASSERT_TRUE(spec.camera.perspective);
  EXPECT_EQ(spec.camera.perspective->fovYDegrees, 30);
}

TEST(SpecArguments, OrbitKeepsTheTargetOfAnOrbit) {
  SpecArguments flags;
  flags.orbit = {30, 20};
  const FrameSpec spec = resolved(R"({"camera": {"orbit": {"target": [1, 2, 3], "distance": 4}}})", flags);
  EXPECT_EQ(spec.camera.orbit->target, (Vec3{1, 2, 3}));
  EXPECT_FALSE(spec.camera.orbit->distance);
}

TEST(SpecArguments, SetTakesDottedPathsJsonAndBareWords) {
  SpecArguments flags;
  flags.sets = {{"shadow.filter.size", "7"},  {"shadow.size", "XLarge"},        {"camera.eye", "[1,2,3]"},
                {"camera.target", "[0,0,0]"}, {"lights[0].type", "point"},      {"lights[0].position", "[0,5,0]"},
                {"lights.1.sun", "{}"},       {"shadow.blendCascades", "false"}};
  const FrameSpec spec = resolved("{}", flags);
  EXPECT_EQ(spec.shadow.filter.size, 7);
  EXPECT_EQ(spec.shadow.size, ShadowSize::XLarge);
  EXPECT_EQ(spec.camera.lookAt->eye, (Vec3{1, 2, 3}));
  EXPECT_EQ(spec.lights->at(0).type, LightType::point);
  EXPECT_EQ(spec.lights->size(), 2u);
  EXPECT_FALSE(spec.shadow.blendCascades);
}

TEST(SpecArguments, TheFormatOfTheOutputsNameStaysBesideASet) {
  SpecArguments flags;
  flags.format = "exr";
  flags.sets = {{"output", R"({"jpegQuality": 40})"}};
  const FrameSpec spec = resolved("{}", flags);
  EXPECT_EQ(spec.output.format, ImageFormat::exr);
  EXPECT_EQ(spec.output.jpegQuality, 40);
  flags.sets = {{"output", "3"}};
  EXPECT_FALSE(refused("{}", flags).empty());
}

TEST(SpecArguments, TheFormatOfSetsIsThatOfTheLast) {
  EXPECT_EQ(formatOfSets({}), std::nullopt);
  EXPECT_EQ(formatOfSets({{"width", "3"}, {"output.jpegQuality", "40"}, {"output", "3"}}), std::nullopt);
  EXPECT_EQ(formatOfSets({{"output.format", "exr"}}), "exr");
  EXPECT_EQ(formatOfSets({{"output.format", "exr"}, {"output.format", "jpeg"}}), "jpeg");
  EXPECT_EQ(formatOfSets({{"output", R"({"format": "npz"})"}}), "npz");
  EXPECT_EQ(formatOfSets({{"output.format", "["}}), std::nullopt);
}

TEST(SpecArguments, SetRefusesWhatIsNoPlaceOrNoJson) {
  const auto pointerOfRefusal = [](const std::string& path, const std::string& value) {
    SpecArguments flags;
    flags.sets = {{path, value}};
    const auto problems = refused(R"({"width": 64, "lights": [{"sun": {}}]})", flags);
    return problems.empty() ? "taken" : problems.front().pointer;
  };
  EXPECT_EQ(pointerOfRefusal("width.deep", "1"), "/width/deep");
  EXPECT_EQ(pointerOfRefusal("lights[7].intensity", "1"), "/lights/7");
  EXPECT_EQ(pointerOfRefusal("lights.7.intensity", "1"), "/lights/7");
  EXPECT_EQ(pointerOfRefusal("lights[].intensity", "1"), "/lights[].intensity");
  EXPECT_EQ(pointerOfRefusal("camera[0].fit", "true"), "/camera");
  EXPECT_EQ(pointerOfRefusal("shadows.enabled", "true"), "/shadows");
  EXPECT_EQ(pointerOfRefusal("height", "[1"), "/height/1");
  EXPECT_EQ(pointerOfRefusal("height", "tall"), "/height");
  EXPECT_THAT(pointerOfRefusal("camera", std::string(20'000, '[')), StartsWith("/camera/0"));
}

TEST(SpecArguments, AnEmptySpecIsTheDefaults) {
  EXPECT_EQ(toJson(resolved("", {})), toJson(FrameSpec{}));
}

TEST(SpecArguments, WhatIsWrongWithAFileByItselfIsToldWithItsName) {
  const auto told = [](const std::string& json, const std::string& file) {
    return problemLine(resolveSpec(json, {}, file).spec.problems().front());
  };
  EXPECT_THAT(told("{\"width\": ", "sun.json"), HasSubstr("(sun.json) This is not JSON"));
  EXPECT_THAT(told("{\"width\": 0}", "sun.json"), StartsWith("/width: (sun.json) "));
  EXPECT_THAT(told("{", "-"), HasSubstr("(standard input) "));
  EXPECT_THAT(told("{", ""), StartsWith("This is not JSON"));
}

TEST(ParseNumbers, TakesExactlyAsManyFiniteNumbersAsAsked) {
  EXPECT_THAT(*parseNumbers("135,-4.5e1", 2, 2), ElementsAre(135, -45));
  EXPECT_THAT(*parseNumbers("1,2,3", 2, 3), ElementsAre(1, 2, 3));
  for (const char* text : {"", "1", "1,", ",1", "1,2,3", "1,2 ", "1,nan", "1,inf", "1;2", "0x1,2", "1,1e999"}) {
    EXPECT_FALSE(parseNumbers(text, 2, 2)) << text;
  }
}

TEST(ParseNumbers, GivesBackWhatWasWritten) {
  EXPECT_TRUE(rc::check([](double a, double b) {
    RC_PRE(std::isfinite(a) && std::isfinite(b));
    const auto text = nlohmann::json(a).dump() + "," + nlohmann::json(b).dump();
    RC_ASSERT(parseNumbers(text, 2, 2) == std::optional(std::vector{a, b}));
  }));
}

TEST(ParseSize, TakesTwoWholeNumbers) {
  EXPECT_EQ(parseSize("1280x720"), (std::array<int, 2>{1280, 720}));
  for (const char* text : {"", "1280", "x", "1280x", "12.5x3", "1280 x 720", "1280X720", "99999999999x1", "1x2x3"}) {
    EXPECT_FALSE(parseSize(text)) << text;
  }
}

} // namespace
} // namespace gnomon::cli
