#include "protocol/evaluation/sweeps.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <set>

#include "protocol/evaluation/evaluation_json.h"

namespace gnomon {
namespace {

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
