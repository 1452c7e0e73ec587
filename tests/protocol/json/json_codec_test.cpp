#include "protocol/json/json_codec.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "protocol/base/result.h"
#include "tests/protocol/found_problems.h"
#include "tests/protocol/spec_generator.h"

namespace gnomon {
namespace {

using ::testing::ElementsAre;

TEST(DecodeFrameSpec, WordsOfEarlierVersionsAreRefusedWithTheirSuccessors) {
  const auto spec = decodeFrameSpec(R"({"shadow": {"technique": "hybrid"}})");
  ASSERT_FALSE(spec);
  EXPECT_EQ(spec.problems()[0].pointer, "/shadow/technique");
  EXPECT_NE(spec.problems()[0].detail.find("rayTraced"), std::string::npos);
}

TEST(DecodeFrameSpec, NothingIsEveryDefault) {
  for (const char* text : {"", "{}", " { } "}) {
    const Result<FrameSpec> spec = decodeFrameSpec(text);
    ASSERT_TRUE(spec) << text;
    EXPECT_EQ(*spec, FrameSpec{}) << text;
  }
}

TEST(DecodeFrameSpec, ReadsEveryField) {
  const Result<FrameSpec> spec = decodeFrameSpec(R"({
    "width": 640, "height": 480,
    "camera": {"eye": [1, 2, 3], "target": [4, 5.5, 6], "perspective": {"fovYDegrees": 30, "near": 0.1, "far": 100}},
    "lights": [
      {"type": "directional", "sun": {"azimuthDegrees": 90, "elevationDegrees": 30}, "shadow": {"cascadeCount": 2}},
      {"type": "spot", "position": [0, 3, 0], "direction": [0, -1, 0], "range": 10, "innerConeDegrees": 20,
       "outerConeDegrees": 30, "color": [1, 0.5, 0.25], "intensity": 500}],
    "shadow": {"enabled": false, "strength": 0.5, "size": "XSmall", "cascadeCount": 3,
               "partition": {"mode": "manual", "splits": [0.1, 0.3, 1]},
               "depthRange": {"mode": "manual", "min": 0, "max": 50},
               "stabilization": "viewSnapping", "blendCascades": false, "filter": {"type": "hard", "size": 7}},
    "atlas": {"size": 2048, "baseSize": 512}, "scene": 2,
    "ambient": {"color": [0, 0, 1], "intensity": 2}, "background": {"color": [0, 1, 0], "alpha": 0},
    "exposure": -1.5, "toneMapping": "none", "antialiasing": "none", "views": ["depth", "atlas"],
    "output": {"format": "exr", "pngCompression": 9, "exrCompression": "zip", "exrPixelType": "float"}})");
  ASSERT_TRUE(spec);
  EXPECT_EQ(spec->width, 640);
  EXPECT_EQ(spec->camera.lookAt->eye, (Vec3{1, 2, 3}));
  EXPECT_EQ(spec->camera.lookAt->target, (Vec3{4, 5.5, 6}));
  EXPECT_EQ(spec->camera.lookAt->up, (Vec3{0, 1, 0}));
  EXPECT_EQ(spec->camera.perspective->far, 100);
  ASSERT_EQ(spec->lights->size(), 2u);
  EXPECT_EQ(spec->lights->at(0).sun->azimuthDegrees, 90);
  EXPECT_EQ(spec->lights->at(0).shadow->cascadeCount, 2);
  EXPECT_EQ(spec->lights->at(1).type, LightType::spot);
  EXPECT_EQ(*spec->lights->at(1).color, (Vec3{1, 0.5, 0.25}));
  EXPECT_EQ(spec->shadow.partition.splits, (std::vector<double>{0.1, 0.3, 1}));
  EXPECT_EQ(spec->shadow.depthRange.min, 0);
  EXPECT_EQ(spec->shadow.stabilization, Stabilization::viewSnapping);
  EXPECT_EQ(spec->shadow.filter, (Filter{FilterType::hard, 7}));
  EXPECT_EQ(spec->atlas, (Atlas{2048, 512}));
  EXPECT_EQ(spec->scene, 2);
  EXPECT_EQ(spec->exposure, -1.5);
  EXPECT_EQ(spec->views, (std::vector{View::depth, View::atlas}));
  EXPECT_EQ(spec->output, (Output{ImageFormat::exr, 9, ExrCompression::zip, ExrPixelType::float_}));
}

TEST(DecodeFrameSpec, ANodeIsAnIndexOrAName) {
  EXPECT_EQ(decodeFrameSpec(R"({"camera":{"node":3}})")->camera.node, (std::variant<int, std::string>(3)));
  EXPECT_EQ(decodeFrameSpec(R"({"camera":{"node":"3"}})")->camera.node, (std::variant<int, std::string>("3")));
}

TEST(DecodeFrameSpec, AWholeNumberMayBeWrittenWithAFraction) {
  EXPECT_EQ(decodeFrameSpec(R"({"width":64.0,"height":1e2})")->width, 64);
  EXPECT_EQ(decodeFrameSpec(R"({"width":64.0,"height":1e2})")->height, 100);
}

struct Refused {
  const char* text;
  const char* pointer;
};

class EachRefusal : public testing::TestWithParam<Refused> {};

TEST_P(EachRefusal, NamesItsPlaceAlone) {
  const Result<FrameSpec> spec = decodeFrameSpec(GetParam().text);
  EXPECT_THAT(pointersOf(spec), ElementsAre(GetParam().pointer)) << GetParam().text;
}

INSTANTIATE_TEST_SUITE_P(
    WrongType, EachRefusal,
    testing::Values(Refused{"3", ""}, Refused{"null", ""}, Refused{R"({"width":true})", "/width"},
                    Refused{R"({"width":[640]})", "/width"}, Refused{R"({"camera":[]})", "/camera"},
                    Refused{R"({"camera":{"eye":[1,2,3,4]}})", "/camera/eye"},
                    Refused{R"({"camera":{"eye":{"x":1}}})", "/camera/eye"},
                    Refused{R"({"camera":{"eye":[1,"2",3]}})", "/camera/eye/1"},
                    Refused{R"({"camera":{"eye":[1,2,null]}})", "/camera/eye/2"},
                    Refused{R"({"camera":{"node":1.5}})", "/camera/node"},
                    Refused{R"({"camera":{"node":true}})", "/camera/node"},
                    Refused{R"({"camera":{"fit":1}})", "/camera/fit"},
                    Refused{R"({"camera":{"perspective":{"near":null}}})", "/camera/perspective/near"},
                    Refused{R"({"lights":{}})", "/lights"}, Refused{R"({"lights":[3]})", "/lights/0"},
                    Refused{R"({"lights":[{"sun":{}},{"sun":[1,2]}]})", "/lights/1/sun"},
                    Refused{R"({"shadow":{"enabled":"yes"}})", "/shadow/enabled"},
                    Refused{R"({"shadow":{"size":3}})", "/shadow/size"}, Refused{R"({"views":"color"})", "/views"},
                    Refused{R"({"views":[0]})", "/views/0"}));

INSTANTIATE_TEST_SUITE_P(
    OutOfRange, EachRefusal,
    testing::Values(
        Refused{R"({"width":16385})", "/width"}, Refused{R"({"width":4294967297})", "/width"},
        Refused{R"({"width":18446744073709551616})", "/width"}, Refused{R"({"width":-9223372036854775809})", "/width"},
        Refused{R"({"width":1e300})", "/width"}, Refused{R"({"width":1e999})", "/width"},
        Refused{R"({"exposure":33})", "/exposure"}, Refused{R"({"scene":-1})", "/scene"},
        Refused{R"({"scene":18446744073709551616})", "/scene"}, Refused{R"({"camera":{"node":-1}})", "/camera/node"},
        Refused{R"({"camera":{"node":""}})", "/camera/node"}, Refused{R"({"camera":{"fit":false}})", "/camera/fit"},
        Refused{R"({"camera":{"eye":[0,1e10,0]}})", "/camera/eye/1"},
        Refused{R"({"camera":{"perspective":{"near":0}}})", "/camera/perspective/near"},
        Refused{R"({"camera":{"orbit":{"elevationDegrees":90.5}}})", "/camera/orbit/elevationDegrees"},
        Refused{R"({"lights":[{"sun":{},"intensity":-1}]})", "/lights/0/intensity"},
        Refused{R"({"lights":[{"sun":{},"color":[0,0,1.5]}]})", "/lights/0/color/2"},
        Refused{R"({"shadow":{"cascadeCount":0}})", "/shadow/cascadeCount"},
        Refused{R"({"shadow":{"size":"large"}})", "/shadow/size"},
        Refused{R"({"shadow":{"partition":{"mode":"manual","splits":[0.5,0]}}})", "/shadow/partition/splits/1"},
        Refused{R"({"shadow":{"partition":{"mode":"manual","splits":[1,1,1,1,1,1,1,1,1]}}})",
                "/shadow/partition/splits"},
        Refused{R"({"atlas":{"size":3000}})", "/atlas/size"},
        Refused{R"({"views":["depth","color","depth"]})", "/views/2"},
        Refused{R"({"output":{"exrPixelType":"float_"}})", "/output/exrPixelType"}));

INSTANTIATE_TEST_SUITE_P(UnknownAndRepeatedKeys, EachRefusal,
                         testing::Values(Refused{R"({"camera":{"lookAt":{}}})", "/camera/lookAt"},
                                         Refused{R"({"lights":[{"sun":{"elevation":3}}]})", "/lights/0/sun/elevation"},
                                         Refused{R"({"shadow":{"filter":{"Size":5}}})", "/shadow/filter/Size"},
                                         Refused{R"({"lights":[{"sun":{},"shadow":{"partition":{"a/b~":1}}}]})",
                                                 "/lights/0/shadow/partition/a~1b~0"},
                                         Refused{R"({"":1})", "/"},
                                         Refused{
                                             R"({"lights":[{"sun":{}},{"sun":{},"color":[1,1,1],"color":[1,1,1]}]})",
                                             "/lights/1/color"}));

TEST(DecodeFrameSpec, TellsEveryProblemAtOnceInTheOrderOfTheText) {
  const Result<FrameSpec> spec = decodeFrameSpec(R"({"hight": 1, "width": -1, "width": 3.7,
    "camera": {"eye": [1, "2", 1e10], "orbit": {}}, "lights": [{"type": "sun"}, {"sun": {}, "range": 3}],
    "shadow": {"partition": {"splits": [0.5]}}})");
  EXPECT_THAT(pointersOf(spec),
              ElementsAre("/width", "/hight", "/width", "/width", "/camera/eye/1", "/camera/eye/2", "/lights/0/type",
                          "/camera/orbit", "/lights/1/range", "/shadow/partition/splits"));
}

TEST(DecodeFrameSpec, AWrongFieldIsNotToldTwice) {
  // near is refused, so nothing is said about its order with far; the missing direction follows from the wrong sun.
  const Result<FrameSpec> spec = decodeFrameSpec(
      R"({"camera":{"orthographic":{"near":"x","far":-5}},"lights":[{"sun":3}],"atlas":{"size":0,"baseSize":8192}})");
  EXPECT_THAT(pointersOf(spec), ElementsAre("/camera/orthographic/near", "/lights/0/sun", "/atlas/size"));
}

TEST(DecodeFrameSpec, AProblemQuotesTheLimitAndTheValue) {
  const Result<FrameSpec> spec = decodeFrameSpec(R"({"width":100000,"shadow":{"filter":{"size":4}},"exposure":1e30})");
  ASSERT_FALSE(spec);
  ASSERT_EQ(spec.problems().size(), 3u);
  EXPECT_EQ(spec.problems()[0].limit, "1..16384");
  EXPECT_EQ(spec.problems()[0].actual, "100000");
  EXPECT_EQ(spec.problems()[1].limit, "3, 5 or 7");
  EXPECT_EQ(spec.problems()[1].actual, "4");
  EXPECT_EQ(spec.problems()[2].limit, "-32..32");
  EXPECT_EQ(spec.problems()[2].actual, "1e+30");
}

TEST(DecodeFrameSpec, ALongValueIsQuotedInShort) {
  const std::string word(100'000, 'x');
  const Result<FrameSpec> spec = decodeFrameSpec(R"({"toneMapping":")" + word + R"(",")" + word + R"(":1})");
  ASSERT_FALSE(spec);
  for (const Problem& problem : spec.problems()) {
    EXPECT_LE(problem.pointer.size() + problem.actual.size(), 200u);
  }
}

TEST(DecodeFrameSpec, AFloodOfProblemsIsCutOff) {
  std::string text = "{";
  for (int i = 0; i < 50'000; ++i) text += "\"k" + std::to_string(i) + "\":0,";
  const Result<FrameSpec> spec = decodeFrameSpec(text + "\"width\":1}");
  ASSERT_FALSE(spec);
  EXPECT_EQ(spec.problems().size(), ProblemList::kMax + 1);
}

TEST(FrameSpecJson, ReadingItBackGivesTheSameSpec) {
  EXPECT_TRUE(rc::check([] {
    const FrameSpec spec = *anySpec();
    const std::string text = toJson(spec).dump();
    const Result<FrameSpec> back = decodeFrameSpec(text);
    if (!back) RC_FAIL(back.problems()[0].pointer + " " + back.problems()[0].detail + " " + text);
    RC_ASSERT(*back == spec);
    RC_ASSERT(toJson(*back).dump() == text);
  }));
}

TEST(FrameSpecJson, AbsentFieldsAreLeftOutAndKeysKeepTheirOrder) {
  const Json json = toJson(FrameSpec{});
  EXPECT_FALSE(json.contains("lights") || json.contains("scene"));
  EXPECT_TRUE(json["camera"].empty());
  std::vector<std::string> keys;
  for (const auto& [key, value] : json.items()) keys.push_back(key);
  EXPECT_THAT(keys, ElementsAre("width", "height", "camera", "shadow", "shadowLightPolicy", "atlas", "nodes", "volumes",
                                "ambient", "environment", "background", "exposure", "toneMapping", "antialiasing",
                                "views", "debug", "device", "output"));
}

TEST(FrameSpecJson, TheViewDirectionStandsDirectlyInTheCamera) {
  FrameSpec spec;
  spec.camera.lookAt = EyeTarget{{1, 2, 3}, {0, 0, 0}, {0, 1, 0}};
  EXPECT_EQ(toJson(spec)["camera"].dump(), R"({"eye":[1.0,2.0,3.0],"target":[0.0,0.0,0.0],"up":[0.0,1.0,0.0]})");
}

TEST(ReportJson, HoldsTheSpecAndTheStagesByName) {
  FrameReport report;
  report.spec.width = 99;
  report.depthRange = {1.5, 20};
  report.atlasSize = {2048, 1024};
  report.lights = {{.light = 1, .shadowed = true, .askedTileSize = 1024, .grantedTileSize = 512, .note = "smaller"}};
  report.lights[0].tiles = {{.near = 1, .far = 3, .tile = {0, 512, 512, 512}, .texelSize = {0.01, 0.02}}};
  report.counts.sceneTriangles = 12'000'000'000;
  report.stages = {{"queue", 0.25}, {"shade", 12}};
  report.warnings = {"bad bytes: \xFF"};
  const Json json = toJson(report);
  EXPECT_EQ(json["spec"]["width"], 99);
  EXPECT_EQ(json["depthRange"].dump(), "[1.5,20.0]");
  EXPECT_EQ(json["lights"][0]["tiles"][0]["tile"].dump(), "[0,512,512,512]");
  EXPECT_EQ(json["counts"]["sceneTriangles"], 12'000'000'000);
  EXPECT_EQ(json["stages"].dump(), R"({"queue":0.25,"shade":12.0})");
  EXPECT_EQ(json["warnings"][0], "bad bytes: ?");
}

} // namespace
} // namespace gnomon
