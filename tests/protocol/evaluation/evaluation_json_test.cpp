#include <algorithm>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <set>

#include "protocol/evaluation/evaluation.h"
#include "protocol/spec/limits.h"
#include "tests/protocol/found_problems.h"

namespace gnomon {
namespace {

using ::testing::ElementsAre;
using ::testing::UnorderedElementsAre;

TEST(DecodeEvaluation, AVariantIsLaidOverTheSpec) {
  const auto evaluation = decodeEvaluation(R"({
      "spec": {"width": 320, "shadow": {"cascadeCount": 2, "filter": {"type": "pcf", "size": 7}},
               "camera": {"eye": [0, 1, 2]}, "lights": [{"sun": {}}, {"sun": {}}]},
      "variants": [{}, {"shadow": {"filter": {"type": "hard", "size": null}}},
                   {"camera": {"eye": null, "orbit": {}}, "lights": [{"sun": {"azimuthDegrees": 10}}]}],
      "repeats": 3, "referenceSamples": 64})");
  ASSERT_TRUE(evaluation) << evaluation.problems()[0].pointer << evaluation.problems()[0].detail;
  EXPECT_EQ(evaluation->repeats, 3);
  EXPECT_EQ(evaluation->referenceSamples, 64);
  ASSERT_EQ(evaluation->variants.size(), 3u);
  EXPECT_EQ(evaluation->variants[0].spec, evaluation->spec);
  EXPECT_EQ(evaluation->variants[0].name, "as given");
  const Shadow& hard = evaluation->variants[1].spec.shadow;
  EXPECT_EQ(hard.filter, (Filter{FilterType::hard, Filter{}.size}));
  EXPECT_EQ(hard.cascadeCount, 2);
  EXPECT_EQ(evaluation->variants[1].name, "filter.type hard, filter.size left out");
  const FrameSpec& turned = evaluation->variants[2].spec;
  EXPECT_TRUE(turned.camera.orbit && !turned.camera.lookAt);
  ASSERT_EQ(turned.lights->size(), 1u);
  EXPECT_EQ((*turned.lights)[0].sun->azimuthDegrees, 10);
}

TEST(DecodeEvaluation, ThePatchIsKeptAsItCame) {
  const auto evaluation = decodeEvaluation(R"({"variants": [{"shadow": {"size": null, "strength": 0.1}}]})");
  ASSERT_TRUE(evaluation);
  EXPECT_EQ(evaluation->variants[0].patch.json, R"({"shadow":{"size":null,"strength":0.1}})");
}

struct Refused {
  const char* text;
  const char* pointer;
};

class EachEvaluation : public testing::TestWithParam<Refused> {};

TEST_P(EachEvaluation, IsRefusedAtItsPlaceAlone) {
  EXPECT_THAT(pointersOf(decodeEvaluation(GetParam().text)), ElementsAre(GetParam().pointer)) << GetParam().text;
}

INSTANTIATE_TEST_SUITE_P(
    Refusals, EachEvaluation,
    testing::Values(
        Refused{"", ""}, Refused{"[]", ""}, Refused{R"({"variants": {}})", "/variants"},
        Refused{R"({"variants": [3]})", "/variants/0"}, Refused{R"({"variants": [{}, null]})", "/variants/1"},
        Refused{R"({"sweep": null})", "/sweep"}, Refused{R"({"sweep": "sizes", "swept": 1})", "/swept"},
        Refused{R"({"sweep": "sizes", "repeats": 101})", "/repeats"},
        Refused{R"({"sweep": "sizes", "referenceSamples": 1025})", "/referenceSamples"},
        Refused{R"({"sweep": "sizes", "path": {}})", "/path"},
        Refused{R"({"sweep": "sizes", "path": {"step": [1, 0]}})", "/path/step"},
        Refused{R"({"sweep": "sizes", "path": {"step": [1, 0, 0], "frames": 1}})", "/path/frames"},
        Refused{R"({"sweep": "sizes", "path": {"step": [1, 0, 0], "frames": 601}})", "/path/frames"},
        Refused{R"({"sweep": "sizes", "path": {"cameras": [{}, {}], "frames": 2}})", "/path/frames"},
        Refused{R"({"sweep": "sizes", "path": {"cameras": [{}]}})", "/path/cameras"},
        Refused{R"({"sweep": "sizes", "path": {"cameras": [{}, {"eye": [1, 1, 1], "fit": true}]}})",
                "/path/cameras/1/fit"},
        Refused{R"({"sweep": "sizes", "path": {"cameras": [{}, {"eye": [0, 0, "z"]}]}})", "/path/cameras/1/eye/2"},
        Refused{R"({"sweep": "sizes", "spec": []})", "/spec"},
        Refused{R"({"sweep": "sizes", "spec": {"width": 0}})", "/spec/width"},
        Refused{R"({"sweep": "sizes", "spec": {"camera": {"fit": true, "orbit": {}}}})", "/spec/camera/fit"},
        Refused{R"({"variants": [{}, {"wide": 3}]})", "/variants/1/wide"},
        Refused{R"({"variants": [{"wide": null}]})", "/variants/0/wide"},
        Refused{R"({"variants": [{"quality": {"maxError": 0.1}}]})", "/variants/0/quality"},
        Refused{R"({"variants": [{"lights": [null]}]})", "/variants/0/lights/0"},
        // Good each, but not together:
        Refused{R"({"spec": {"camera": {"fit": true}}, "variants": [{"camera": {"orbit": {}}}]})",
                "/variants/0/camera/fit"}));

TEST(DecodeEvaluation, AProblemOfTheSpecIsToldOnceAndThoseOfVariantsBesideIt) {
  const auto evaluation =
      decodeEvaluation(R"({"spec": {"width": 0}, "variants": [{}, {"height": 0}, {"exposure": 99}], "repeats": -1})");
  EXPECT_THAT(pointersOf(evaluation),
              UnorderedElementsAre("/spec/width", "/repeats", "/variants/1/height", "/variants/2/exposure"));
}

TEST(DecodeEvaluation, AVariantMayNotMendTheSpec) {
  EXPECT_THAT(pointersOf(decodeEvaluation(R"({"spec": {"width": 0}, "variants": [{"width": 9}]})")),
              ElementsAre("/spec/width"));
}

TEST(DecodeEvaluation, ThereIsALimitOfVariants) {
  Json request = {{"variants", Json::array()}};
  for (std::size_t i = 0; i < kLimits.maxVariants; ++i) request["variants"].push_back(Json::object());
  EXPECT_TRUE(decodeEvaluation(request.dump()));
  request["variants"].push_back(Json::object());
  const auto refused = decodeEvaluation(request.dump());
  EXPECT_THAT(pointersOf(refused), ElementsAre("/variants"));
}

TEST(EvaluationReportJson, ReadsBackAsItWasWritten) {
  EvaluationReport report;
  report.renderer.renderer = "llvmpipe";
  report.reference = {12.5, 3, 256, 2};
  EvaluationRow good;
  good.variant = {R"({"shadow":{"technique":"rayTraced"}})"};
  good.name = "rayTraced";
  good.milliseconds = 40.25;
  good.stages = {{"survey", 10}, {"shade", 30.25}};
  good.memoryBytes = 1'234'567'890'123;
  good.metrics.emplace();
  good.metrics->receivers = 5000;
  good.metrics->misclassified = 0.001;
  good.metrics->edgeDisplacement = EdgeDisplacement{0.5, 0.25, 2, 3};
  good.pareto = true;
  EvaluationRow bad;
  bad.name = "shadowVolume";
  bad.pareto = false;
  bad.problems = {{"unsupportedFeature", "/shadow/technique", "It can't.", std::nullopt, "a mask"}};
  report.rows = {good, bad};
  report.rankedBy = RankedError::rms;
  const Json json = toJson(report);
  EXPECT_EQ(json["rows"][0]["variant"]["shadow"]["technique"], "rayTraced");
  EXPECT_EQ(json["rows"][0]["stages"]["shade"], 30.25);
  EXPECT_EQ(json["rankedBy"], "rms");
  EXPECT_FALSE(json["rows"][1].contains("metrics") || json["rows"][1].contains("milliseconds"));
  const auto back = readEvaluationReport(json.dump());
  ASSERT_TRUE(back);
  EXPECT_EQ(toJson(*back), json);
}

TEST(EvaluationReportJson, WhatIsNewerThanThisClientIsPassedOver) {
  const auto report = readEvaluationReport(R"({"rows": [{"name": "a", "luck": 7}], "weather": "fine"})");
  ASSERT_TRUE(report);
  EXPECT_EQ(report->rows[0].name, "a");
  EXPECT_EQ(report->rankedBy, RankedError::misclassified) << "which an older server does not say";
  for (const char* text : {"", "[]", "{}", R"({"rows": 3})", R"({"rows": []})"})
    EXPECT_FALSE(readEvaluationReport(text));
}

std::vector<std::string> namesOf(const char* sweep) {
  const auto evaluation = decodeEvaluation(std::string(R"({"sweep": ")") + sweep + "\"}");
  EXPECT_TRUE(evaluation) << sweep;
  std::vector<std::string> names;
  for (const Variant& variant : evaluation ? evaluation->variants : std::vector<Variant>())
    names.push_back(variant.name);
  return names;
}

TEST(Sweeps, EachHasItsVariantsOnce) {
  EXPECT_EQ(namesOf("techniques"), (std::vector<std::string>{"hard", "pcf 3", "pcf 5", "pcss", "shadowVolume",
                                                             "rayTraced", "lightMap", "auto"}));
  EXPECT_EQ(namesOf("filters").size(), 2u + 4 * 3);
  EXPECT_EQ(namesOf("sizes").size(), 5u * 3);
  const auto all = namesOf("all");
  EXPECT_EQ(all.size(), 8u + 14 + 15 - 4);
  EXPECT_EQ(std::set<std::string>(all.begin(), all.end()).size(), all.size());
}

TEST(Sweeps, SetWhatTheirNamesSay) {
  const auto evaluation = decodeEvaluation(R"({"sweep": "sizes"})");
  ASSERT_TRUE(evaluation);
  const auto found = std::find_if(evaluation->variants.begin(), evaluation->variants.end(),
                                  [](const Variant& variant) { return variant.name == "hard 2 x Small"; });
  ASSERT_NE(found, evaluation->variants.end());
  EXPECT_EQ(found->spec.shadow.size, ShadowSize::Small);
  EXPECT_EQ(found->spec.shadow.cascadeCount, 2);
  EXPECT_EQ(found->spec.shadow.filter.type, FilterType::hard);
}

TEST(Sweeps, TakeAwayWhatWouldContradictThem) {
  const char* spec = R"({"shadow": {"filter": {"type": "pcf", "radius": 0.1}, "cascadeCount": 2,
                                    "partition": {"mode": "manual", "splits": [0.5, 1]}}})";
  for (const char* sweep : {"techniques", "filters", "sizes", "all"}) {
    const auto evaluation = decodeEvaluation(std::string(R"({"spec": )") + spec + R"(, "sweep": ")" + sweep + "\"}");
    EXPECT_TRUE(evaluation) << sweep << evaluation.problems()[0].detail;
  }
}

TEST(Sweeps, GoForLightsWithAShadowOfTheirOwnAndLeaveTheRestOfThem) {
  const auto evaluation = decodeEvaluation(R"({"sweep": "techniques", "spec": {
      "lights": [{"sun": {}, "intensity": 5, "shadow": {"cascadeCount": 3}}, {"sun": {"elevationDegrees": 9}}]}})");
  ASSERT_TRUE(evaluation);
  for (const Variant& variant : evaluation->variants) {
    const auto& lights = *variant.spec.lights;
    ASSERT_EQ(lights.size(), 2u);
    EXPECT_EQ(lights[0].shadow->technique, variant.spec.shadow.technique) << variant.name;
    EXPECT_EQ(lights[0].shadow->filter, variant.spec.shadow.filter) << variant.name;
    EXPECT_EQ(lights[0].shadow->cascadeCount, 3);
    EXPECT_EQ(lights[0].intensity, 5);
    EXPECT_EQ(lights[1].sun->elevationDegrees, 9);
    EXPECT_FALSE(lights[1].shadow);
  }
}

TEST(Sweeps, ANameSaysWhatAPatchChangesAndIsShort) {
  EXPECT_EQ(variantName(Json::parse(R"({"shadow":{"technique":"rayTraced","filter":{"size":7}},"exposure":1})")),
            "technique rayTraced, filter.size 7, exposure 1");
  EXPECT_EQ(variantName(Json::parse(R"({"lights":[{},{}],"camera":{}})")), "lights of 2, camera {}");
  EXPECT_LE(variantName(Json{{"camera", {{"node", std::string(500, 'x')}}}}).size(), 80u);
}

} // namespace
} // namespace gnomon
