#include "renderer/evaluation/quality.h"

#include <gtest/gtest.h>

#include "protocol/spec/validate.h"

namespace gnomon {
namespace {

struct Measured {
  double milliseconds;
  double misclassified;
};

/// As many trials as there are measurements; a negative time = it can't be drawn.
Result<QualityReport> chosenFrom(const Quality& target, const std::vector<Measured>& measured) {
  std::vector<QualityTrial> trials(measured.size());
  EvaluationReport report;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    trials[i].settings = std::to_string(i);
    EvaluationRow row;
    if (measured[i].milliseconds >= 0) {
      row.milliseconds = measured[i].milliseconds;
      row.metrics = ErrorMetrics{};
      row.metrics->misclassified = measured[i].misclassified;
    } else {
      row.problems = {{"unsupportedFeature", "", "masked casters", {}, {}}};
    }
    report.rows.push_back(row);
  }
  return chooseTrial(target, trials, report);
}

std::string settingsOf(const QualityReport& report) {
  return report.tried.at(report.chosen).settings;
}

const std::vector<Measured> kUsual{{10, 0.05}, {20, 0.01}, {30, 0.02}, {40, 0}, {35, 0}};

TEST(Quality, H3_TheFastestThatHoldsAnErrorIsChosen) {
  const auto loose = chosenFrom({.maxError = 0.1}, kUsual);
  EXPECT_EQ(settingsOf(*loose), "0");
  EXPECT_EQ(loose->met, true);
  EXPECT_EQ(settingsOf(*chosenFrom({.maxError = 0.02}, kUsual)), "1");
  EXPECT_EQ(settingsOf(*chosenFrom({.maxError = 0}, kUsual)), "4");
}

TEST(Quality, H3_TheMostExactThatFitsATimeIsChosen) {
  EXPECT_EQ(settingsOf(*chosenFrom({.maxMilliseconds = 15}, kUsual)), "0");
  EXPECT_EQ(settingsOf(*chosenFrom({.maxMilliseconds = 31}, kUsual)), "1");
  const auto wide = chosenFrom({.maxMilliseconds = 100}, kUsual);
  EXPECT_EQ(settingsOf(*wide), "4") << "of two without an error the faster";
  EXPECT_EQ(wide->met, true);
}

TEST(Quality, H3_ATargetThatNothingReachesGivesTheBestAndSaysSo) {
  const auto slow = chosenFrom({.maxMilliseconds = 1}, kUsual);
  EXPECT_EQ(settingsOf(*slow), "0");
  EXPECT_EQ(slow->met, false);
  const auto wrong = chosenFrom({.maxError = 0}, {{10, 0.5}, {20, 0.1}, {30, 0.1}});
  EXPECT_EQ(settingsOf(*wrong), "1");
  EXPECT_EQ(wrong->met, false);
}

TEST(Quality, WhatCannotBeDrawnIsLeftOut) {
  const auto report = chosenFrom({.maxError = 0}, {{-1, 0}, {20, 0.1}, {30, 0}});
  EXPECT_EQ(settingsOf(*report), "2");
  EXPECT_EQ(report->tried.size(), 2u);
  const auto nothing = chosenFrom({.maxError = 0}, {{-1, 0}, {-1, 0}});
  ASSERT_FALSE(nothing);
  EXPECT_EQ(nothing.problems()[0].pointer, "/quality");
  EXPECT_NE(nothing.problems()[0].detail.find("masked casters"), std::string::npos);
}

TEST(Quality, TrialsChangeTheirOwnSettingsAlone) {
  FrameSpec spec;
  spec.quality = Quality{.maxError = 0.01};
  spec.shadow.strength = 0.5;
  spec.shadow.partition = {PartitionMode::manual, 0.5, {0.1, 0.2, 0.5, 1.0}};
  Light lamp{.type = LightType::point, .position = Vec3{0, 3, 0}};
  lamp.shadow = Shadow{};
  lamp.shadow->strength = 0.25;
  lamp.shadow->enabled = false;
  spec.lights = {Light{.sun = Sun{}}, lamp};
  const auto trials = qualityTrials(spec);
  ASSERT_GE(trials.size(), 8u);
  for (const QualityTrial& trial : trials) {
    const FrameSpec chosen = withTrial(spec, trial);
    EXPECT_TRUE(validate(chosen).empty()) << trial.settings;
    EXPECT_FALSE(chosen.quality);
    EXPECT_EQ(chosen.shadow.strength, 0.5);
    EXPECT_EQ(chosen.shadow.technique, trial.shadow.technique);
    EXPECT_EQ((*chosen.lights)[1].shadow->strength, 0.25);
    EXPECT_FALSE((*chosen.lights)[1].shadow->enabled);
    EXPECT_EQ((*chosen.lights)[1].shadow->technique, trial.shadow.technique);
    EXPECT_EQ(chosen.camera, spec.camera);
  }
  const Evaluation evaluation = qualityEvaluation(spec, trials);
  EXPECT_EQ(evaluation.variants.size(), trials.size());
  EXPECT_FALSE(evaluation.spec.quality);
}

TEST(Quality, ProblemsOfTheMeasurementPointIntoTheSpec) {
  FrameSpec spec;
  spec.quality = Quality{.maxError = 0.01};
  const auto refused = chooseQuality(spec, [](const Evaluation&) -> Result<EvaluationReport> {
    return Problems{{ProblemCode::tooLarge, "/spec/width", "", "", ""}, {ProblemCode::busy, "", "", "", ""}};
  });
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.problems()[0].pointer, "/width");
  EXPECT_EQ(refused.problems()[1].pointer, "");
}

TEST(Quality, TheChosenTrialIsTheFrames) {
  FrameSpec spec;
  spec.quality = Quality{.maxError = 0.01};
  const auto report = chooseQuality(spec, [](const Evaluation& evaluation) -> Result<EvaluationReport> {
    EvaluationReport measured;
    for (std::size_t i = 0; i < evaluation.variants.size(); ++i) {
      EvaluationRow row;
      row.milliseconds = 10;
      row.metrics = ErrorMetrics{};
      row.metrics->misclassified = i == 2 ? 0.0 : 0.5;
      measured.rows.push_back(row);
    }
    return measured;
  });
  ASSERT_TRUE(report);
  EXPECT_EQ(report->chosen, 2u);
  EXPECT_EQ(report->met, true);
  EXPECT_EQ(withChoice(spec, *report), withTrial(spec, report->tried[2]));
}

} // namespace
} // namespace gnomon
