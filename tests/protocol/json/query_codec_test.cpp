#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <rapidcheck/gtest.h>

#include "protocol/base/json.h"
#include "protocol/base/text.h"
#include "protocol/json/json_codec.h"
#include "tests/protocol/found_problems.h"
#include "tests/protocol/spec_generator.h"

namespace gnomon {
namespace {

using ::testing::ElementsAre;
using Steps = std::vector<FieldStep>;

TEST(DecodeFrameQuery, NothingIsEveryDefault) {
  ASSERT_TRUE(decodeFrameQuery({}));
  EXPECT_EQ(*decodeFrameQuery({}), FrameSpec{});
}

TEST(DecodeFrameQuery, KeysAreDottedPaths) {
  const Result<FrameSpec> spec = decodeFrameQuery({{"camera.orbit.azimuthDegrees", "40"},
                                                   {"camera.orbit.target", "[1,2,3]"},
                                                   {"width", "320"},
                                                   {"shadow.filter", R"({"type":"hard"})"},
                                                   {"shadow.blendCascades", "false"}});
  ASSERT_TRUE(spec);
  EXPECT_EQ(spec->width, 320);
  EXPECT_EQ(spec->camera.orbit->azimuthDegrees, 40);
  EXPECT_EQ(spec->camera.orbit->target, (Vec3{1, 2, 3}));
  EXPECT_EQ(spec->shadow.filter.type, FilterType::hard);
  EXPECT_FALSE(spec->shadow.blendCascades);
}

TEST(DecodeFrameQuery, HasShortForms) {
  const Result<FrameSpec> spec = decodeFrameQuery({{"sun", "135,40.5"}, {"view", "depth"}, {"format", "exr"}});
  ASSERT_TRUE(spec);
  ASSERT_EQ(spec->lights->size(), 1u);
  EXPECT_EQ(spec->lights->at(0).type, LightType::directional);
  EXPECT_EQ(spec->lights->at(0).sun, (Sun{135, 40.5}));
  EXPECT_EQ(spec->views, std::vector{View::depth});
  EXPECT_EQ(spec->output.format, ImageFormat::exr);
}

TEST(DecodeFrameQuery, ASunStandsByPlaceAndTime) {
  const Result<FrameSpec> spec = decodeFrameQuery({{"sun", "48.1,11.6 2026-06-21T17:00+02:00"}});
  ASSERT_TRUE(spec);
  EXPECT_EQ(spec->lights->at(0).sun,
            (Sun{.latitudeDegrees = 48.1, .longitudeDegrees = 11.6, .time = "2026-06-21T17:00+02:00"}));
  // A plus that is not escaped arrives as a space.
  EXPECT_THAT(pointersOf(decodeFrameQuery({{"sun", "48.1,11.6 2026-06-21T17:00 02:00"}})), ElementsAre("sun"));
  EXPECT_THAT(pointersOf(decodeFrameQuery({{"sun", "99,11.6 2026-06-21T17:00Z"}})), ElementsAre("sun"));
}

TEST(DecodeFrameQuery, ABareWordIsAString) {
  EXPECT_EQ(decodeFrameQuery({{"camera.node", "Camera 1"}})->camera.node, (std::variant<int, std::string>("Camera 1")));
  EXPECT_EQ(decodeFrameQuery({{"camera.node", "7"}})->camera.node, (std::variant<int, std::string>(7)));
  EXPECT_EQ(decodeFrameQuery({{"camera.node", "\"7\""}})->camera.node, (std::variant<int, std::string>("7")));
  EXPECT_EQ(decodeFrameQuery({{"toneMapping", "none"}})->toneMapping, ToneMapping::none);
}

TEST(DecodeFrameQuery, ProblemsNameTheKeyThatWasWritten) {
  const std::vector<std::tuple<std::string, std::string, std::string>> cases = {
      {"width", "", "width"},
      {"width", "null", "width"},
      {"width", "1e999", "width"},
      {"width", "-1", "width"},
      {"width", "3.7", "width"},
      {"width", "18446744073709551616", "width"},
      {"width", "[[[", "width"},
      {"width", "12abc", "width"},
      {"exposure", "NaN", "exposure"},
      {"exposure", "Infinity", "exposure"},
      {"camera.perspective.near", "0", "camera.perspective.near"},
      {"camera.orbit", R"({"distance":-1})", "camera.orbit"},
      {"camera.orbit.distnce", "3", "camera.orbit.distnce"},
      {"sun", "135,40,3", "sun"},
      {"sun", "135,91", "sun"},
      {"sun", "135,", "sun"},
      {"sun", "a,3", "sun"},
      {"view", "dpth", "view"},
      {"format", "gif", "format"},
      {"format", "\xFF", "format"},
      {"", "1", ""},
      {"shadow.depthRange", R"({"mode":"manual","min":3,"max":2})", "shadow.depthRange"},
      {"width", std::string(20'000, '['), "width"},
  };
  for (const auto& [key, value, pointer] : cases) {
    const std::vector<std::string> found = pointersOf(decodeFrameQuery({{key, value}}));
    ASSERT_EQ(found.size(), 1u) << key << "=" << value;
    EXPECT_EQ(found[0], pointer) << key << "=" << value;
  }
}

TEST(DecodeFrameQuery, AnUnknownPathNamesItsKey) {
  EXPECT_THAT(pointersOf(decodeFrameQuery({{"a..b", "1"}})), ElementsAre("a..b"));
  EXPECT_THAT(pointersOf(decodeFrameQuery({{"camera.eye.x", "1"}})), ElementsAre("camera.eye.x"));
}

TEST(DecodeFrameQuery, ElementsOfListsHaveTheirIndexInBrackets) {
  const Result<FrameSpec> spec = decodeFrameQuery({{"lights[1].position", "[0,5,0]"},
                                                   {"lights[1].type", "point"},
                                                   {"lights[0].intensity", "7"},
                                                   {"nodes[0].node", "box"},
                                                   {"nodes.0.visible", "false"},
                                                   {"sun", "10,20"}});
  ASSERT_TRUE(spec);
  ASSERT_EQ(spec->lights->size(), 2u);
  EXPECT_EQ(spec->lights->at(0).sun, (Sun{10, 20}));
  EXPECT_EQ(spec->lights->at(0).intensity, 7);
  EXPECT_EQ(spec->lights->at(1).type, LightType::point);
  ASSERT_EQ(spec->nodes.size(), 1u);
  EXPECT_EQ(spec->nodes[0].visible, false);
}

TEST(DecodeFrameQuery, WhatIsWrongWithAListIsToldAtItsKey) {
  for (const char* key : {"lights[1].type", "lights[].type", "lights[x].type", "lights[0", "lights[0]type", "[0].type",
                          "lights[9999999999].type", "views[0][0]"}) {
    EXPECT_THAT(pointersOf(decodeFrameQuery({{key, "spot"}})), ElementsAre(key));
  }
  EXPECT_THAT(pointersOf(decodeFrameQuery({{"lights[0].type", "spots"}})), ElementsAre("lights[0].type"));
  EXPECT_THAT(pointersOf(decodeFrameQuery({{"lights[0].type", "spot"}, {"lights[0].range", "1"}})),
              ElementsAre("lights[0].direction", "lights[0].position"));
}

TEST(DecodeFrameQuery, WhatIsAbsentIsNamedByItsPath) {
  EXPECT_THAT(pointersOf(decodeFrameQuery({{"shadow.depthRange.mode", "manual"}})),
              ElementsAre("shadow.depthRange.min", "shadow.depthRange.max"));
}

TEST(DecodeFrameQuery, AFieldCanBeGivenOnlyOnce) {
  EXPECT_THAT(pointersOf(decodeFrameQuery({{"format", "png"}, {"output.format", "png"}})),
              ElementsAre("output.format"));
  EXPECT_THAT(pointersOf(decodeFrameQuery({{"view", "color"}, {"views", "[\"depth\"]"}})), ElementsAre("views"));
  EXPECT_THAT(pointersOf(decodeFrameQuery({{"sun", "1,2"}, {"lights", "[]"}})), ElementsAre("lights"));
  EXPECT_THAT(pointersOf(decodeFrameQuery({{"camera", "{}"}, {"camera.fit", "true"}})), testing::IsEmpty());
  EXPECT_THAT(pointersOf(decodeFrameQuery({{"camera.fit", "true"}, {"camera", "{}"}})), ElementsAre("camera"));
  EXPECT_THAT(pointersOf(decodeFrameQuery({{"width", "3"}, {"width.x", "3"}})), ElementsAre("width.x"));
}

TEST(DecodeFrameQuery, IsBounded) {
  std::string path = "a";
  for (int i = 0; i < 1000; ++i) path += ".a";
  EXPECT_EQ(pointersOf(decodeFrameQuery({{path, "1"}})).size(), 1u);
  const std::vector<std::pair<std::string, std::string>> many(1000, {"width", "1"});
  ASSERT_FALSE(decodeFrameQuery(many));
  EXPECT_EQ(decodeFrameQuery(many).problems()[0].code, ProblemCode::tooLarge);
}

TEST(DecodeFrameQuery, ASpecsMembersAsKeysGiveTheSpec) {
  EXPECT_TRUE(rc::check([] {
    const FrameSpec spec = *anySpec();
    const Json json = toJson(spec);
    std::vector<std::pair<std::string, std::string>> query;
    for (const auto& [key, value] : json.items()) {
      const bool takeApart = value.is_object() && !value.empty() && *rc::gen::arbitrary<bool>();
      if (!takeApart) {
        query.emplace_back(key, value.dump());
      } else {
        for (const auto& [inner, member] : value.items()) query.emplace_back(key + "." + inner, member.dump());
      }
    }
    const Result<FrameSpec> back = decodeFrameQuery(query);
    RC_ASSERT(bool(back));
    RC_ASSERT(*back == spec);
  }));
}

TEST(DecodeFrameQuery, AnyTextIsTakenOrRefused) {
  EXPECT_TRUE(rc::check([](const std::vector<std::pair<std::string, std::string>>& query) {
    const Result<FrameSpec> spec = decodeFrameQuery(query);
    if (spec) return;
    for (const Problem& problem : spec.problems()) RC_ASSERT(isUtf8(problem.pointer) && isUtf8(problem.actual));
  }));
}

TEST(FieldPath, HasIndicesInBrackets) {
  EXPECT_EQ(*fieldSteps("lights[0].sun.azimuthDegrees"), (Steps{"lights", std::size_t{0}, "sun", "azimuthDegrees"}));
  EXPECT_EQ(*fieldSteps("a[1][20]"), (Steps{"a", std::size_t{1}, std::size_t{20}}));
  EXPECT_EQ(*fieldSteps("lights.0.type"), *fieldSteps("lights[0].type"));
  EXPECT_EQ(*fieldSteps("width"), (Steps{"width"}));
  EXPECT_EQ(*fieldSteps("a..b"), (Steps{"a", "", "b"}));
}

TEST(FieldPath, OtherBracketsAreProblems) {
  for (const char* path : {"lights[]", "lights[", "lights]", "lights[-1]", "lights[1.5]", "lights[0]x", "[0]", "a.[0]",
                           "lights[0", "lights[1000000000]", "lights[ 1]", "lights[+1]"}) {
    ASSERT_FALSE(fieldSteps(path)) << path;
    EXPECT_EQ(fieldSteps(path).problems()[0].limit, "as lights[0].type") << path;
  }
}

TEST(FieldPath, IsThatOfItsPointer) {
  EXPECT_EQ(pointerOf(*fieldSteps("lights[2].shadow.size")), "/lights/2/shadow/size");
  EXPECT_EQ(fieldPath("/lights/2/shadow/size"), "lights[2].shadow.size");
  EXPECT_EQ(fieldPath(""), "");
}

RC_GTEST_PROP(FieldPath, ComesBackFromItsPointer, ()) {
  std::string path = "a";
  for (const bool isIndex : *rc::gen::arbitrary<std::vector<bool>>()) {
    path += isIndex ? "[" + std::to_string(*rc::gen::inRange(0, 1000)) + "]" : ".b";
  }
  RC_ASSERT(fieldPath(pointerOf(*fieldSteps(path))) == path);
}

} // namespace
} // namespace gnomon
