// Whole evaluations, drawn and traced.
#include <algorithm>
#include <random>
#include <set>
#include <thread>

#include "protocol/evaluation/evaluation.h"
#include "tests/renderer/frame_fixture.h"
#include "tests/support/tested_device.h"

namespace gnomon {
namespace {

constexpr const char* kSpec = R"({"width": 320, "height": 180, "camera": {"node": "camera"},
    "lights": [{"sun": {"azimuthDegrees": 130, "elevationDegrees": 35}}], "atlas": {"baseSize": 512}})";

Evaluation evaluationOf(const std::string& rest, const std::string& spec = kSpec) {
  auto evaluation = decodeEvaluation(R"({"repeats": 2, "spec": )" + spec + ", " + rest + "}");
  EXPECT_TRUE(evaluation) << evaluation.problems()[0].pointer << evaluation.problems()[0].detail;
  return evaluation ? *evaluation : Evaluation{};
}

Result<EvaluationReport> evaluated(const ScenePtr& scene, const Evaluation& evaluation,
                                   const EvaluationListener& listener = {}) {
  Renderer& renderer = testing::sharedRenderer();
  return evaluate(scene, evaluation, renderer.info(), evaluationTools(renderer, scene), listener);
}

const EvaluationRow& rowOf(const EvaluationReport& report, const std::string& name) {
  const auto found =
      std::find_if(report.rows.begin(), report.rows.end(), [&](const EvaluationRow& row) { return row.name == name; });
  EXPECT_NE(found, report.rows.end()) << name;
  return *found;
}

TEST(Evaluate, ASweepMeasuresEveryFilterAgainstOneReference) {
  const ScenePtr box = testing::generatedScene("box_on_plane");
  const auto report = evaluated(box, evaluationOf(R"("sweep": "filters")"));
  ASSERT_TRUE(report) << report.problems()[0].detail;
  ASSERT_EQ(report->rows.size(), 14u);
  EXPECT_EQ(report->reference.frames, 1);
  EXPECT_GT(report->reference.milliseconds, 0);
  EXPECT_GT(report->reference.buildMilliseconds, 0);
  EXPECT_EQ(report->renderer.renderer, testing::sharedRenderer().info().renderer);
  std::set<std::uint64_t> receivers;
  for (const EvaluationRow& row : report->rows) {
    ASSERT_TRUE(row.metrics && row.milliseconds && row.pareto) << row.name;
    receivers.insert(row.metrics->receivers);
    EXPECT_GT(*row.milliseconds, 0) << row.name;
    EXPECT_GT(row.memoryBytes, 512u * 512 * 4) << row.name;
    EXPECT_EQ(row.stages.front().stage, "upload");
    EXPECT_TRUE(row.metrics->predicted) << row.name;
    // A box of one piece and texels of two pixels: wrong along its edges, and nowhere else.
    EXPECT_LT(row.metrics->misclassified, 0.02) << row.name;
    EXPECT_NEAR(row.metrics->misclassified, row.metrics->falseShadow + row.metrics->falseLit, 1e-12);
  }
  EXPECT_EQ(receivers.size(), 1u) << "all see the same receivers";
  EXPECT_GT(*receivers.begin(), 10'000u);
  EXPECT_GT(rowOf(*report, "hard").metrics->misclassified, 0);
  EXPECT_TRUE(std::any_of(report->rows.begin(), report->rows.end(), [](const auto& row) { return *row.pareto; }));
}

TEST(Evaluate, SamplesOfAnEnvironmentAreMeasuredAgainstOneReferenceOfManyRays) {
  const ScenePtr box = testing::generatedScene("box_on_plane");
  constexpr const char* kAround = R"({"width": 160, "height": 90, "camera": {"node": "camera"}, "lights": [],
      "environment": {"shadows": "rays"}, "debug": {"light": "environment"}})";
  const Evaluation evaluation = evaluationOf(R"("variants": [{"environment": {"samples": 1}},
      {"environment": {"samples": 64}}, {"debug": null}])",
                                             kAround);
  const auto report = evaluated(box, evaluation);
  ASSERT_TRUE(report) << report.problems()[0].detail;
  EXPECT_EQ(report->rankedBy, RankedError::rms);
  EXPECT_EQ(report->reference.samples, 1024);
  EXPECT_EQ(report->reference.frames, 1);
  ASSERT_TRUE(report->rows[0].metrics && report->rows[1].metrics);
  EXPECT_GT(report->rows[0].metrics->rms, 1.2 * report->rows[1].metrics->rms);
  EXPECT_GT(report->rows[1].metrics->rms, 0);
  EXPECT_TRUE(*report->rows[1].pareto) << "by rms, whatever is misclassified";
  EXPECT_TRUE(report->rows[2].problems) << "there is no light";
  for (std::size_t i = 0; i < 2; ++i) {
    FrameSpec spec = evaluation.variants[i].spec;
    spec.views = {View::error};
    const auto frame = testing::sharedRenderer().render(box, spec);
    ASSERT_TRUE(frame) << frame.problems()[0].detail;
    EXPECT_DOUBLE_EQ(report->rows[i].metrics->rms, frame->report.error->rms);
  }
}

TEST(Evaluate, SkiesAreReferencesOfTheirOwnAndHaveNoShimmer) {
  const ScenePtr box = testing::generatedScene("box_on_plane");
  constexpr const char* kSky = R"({"width": 96, "height": 54, "camera": {"node": "camera"}, "lights": [],
      "environment": {"shadows": "rays", "sky": {"sun": {"azimuthDegrees": 130, "elevationDegrees": 35}}},
      "debug": {"light": "environment"}})";
  const auto report = evaluated(box, evaluationOf(R"("variants": [{"environment": {"samples": 2}},
      {"environment": {"sky": null}}, {"environment": {"rotationDegrees": 0, "samples": 8}}])",
                                                  kSky));
  ASSERT_TRUE(report) << report.problems()[0].detail;
  EXPECT_EQ(report->reference.frames, 2);
  for (const EvaluationRow& row : report->rows) EXPECT_TRUE(row.metrics && row.milliseconds) << row.name;
  const auto moving =
      evaluated(box, evaluationOf(R"("variants": [{}], "path": {"step": [0.01, 0, 0], "frames": 3})", kSky));
  ASSERT_TRUE(moving);
  ASSERT_TRUE(moving->rows[0].problems);
  EXPECT_EQ(moving->rows[0].problems->front().pointer, "/debug/light");
}

/// A row's error is that of the frame that its variant gives: view `error` of that very spec.
void expectErrorsOfFrames(const ScenePtr& scene, const std::vector<Variant>& variants, const EvaluationReport& report) {
  for (std::size_t i = 0; i < variants.size(); ++i) {
    if (!report.rows[i].metrics) continue; // what this device can't draw
    FrameSpec spec = variants[i].spec;
    spec.views = {View::color, View::error};
    const auto frame = testing::sharedRenderer().render(scene, spec);
    ASSERT_TRUE(frame) << frame.problems()[0].detail;
    EXPECT_DOUBLE_EQ(report.rows[i].metrics->misclassified, frame->report.error->misclassified)
        << variants[i].name << " " << jsonText(toJson(spec.camera));
  }
}

TEST(Evaluate, ATargetThatIsMetHoldsForTheFrameThatIsSent) {
  std::mt19937 random(41);
  const auto within = [&](double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random);
  };
  int met = 0;
  for (int i = 0; i < 100; ++i) {
    const ScenePtr scene = testing::generatedScene(i % 2 == 0 ? "long_row" : "tilted_planes");
    const Json json = {
        {"width", 160},
        {"height", 90},
        {"camera",
         {{"orbit",
           {{"azimuthDegrees", within(0, 360)},
            {"elevationDegrees", within(2, 40)},
            {"target", {within(-8, 8), within(0, 3), within(-8, 8)}},
            {"distance", within(4, 30)}}}}},
        {"lights", {{{"sun", {{"azimuthDegrees", within(0, 360)}, {"elevationDegrees", within(12, 70)}}}}}},
        {"quality", {{"maxError", within(0.0005, 0.01)}}}};
    const auto spec = decodeFrameSpec(json.dump());
    ASSERT_TRUE(spec);
    const auto quality = chooseQuality(*spec, [&](Evaluation evaluation) {
      evaluation.repeats = 1;
      auto report = evaluated(scene, evaluation);
      if (report) expectErrorsOfFrames(scene, evaluation.variants, *report);
      return report;
    });
    if (!quality) continue; // where the camera sees no surface that the sun reaches
    met += quality->met == true ? 1 : 0;
  }
  EXPECT_GT(met, 50);
}

TEST(Evaluate, EveryShadowedLightCounts) {
  const ScenePtr box = testing::generatedScene("box_on_plane");
  const std::string lamp = R"({"type": "point", "position": [3, 4, 2], "intensity": 20})";
  const std::string sun = R"({"sun": {"azimuthDegrees": 130, "elevationDegrees": 35}})";
  const auto report = evaluated(
      box, evaluationOf(R"("variants": [{}, {"lights": [)" + sun + "," + lamp + R"(]}, {"lights": [)" + lamp + "]}]"));
  ASSERT_TRUE(report);
  EXPECT_EQ(report->reference.frames, 3);
  EXPECT_EQ(report->rows[1].metrics->receivers,
            report->rows[0].metrics->receivers + report->rows[2].metrics->receivers);
}

TEST(Evaluate, AVariantThatCanNotBeDrawnIsARowWithItsProblem) {
  const ScenePtr box = testing::generatedScene("box_on_plane");
  std::vector<std::size_t> told;
  EvaluationListener listener;
  listener.row = [&](std::size_t index, const EvaluationRow& row) {
    told.push_back(index);
    EXPECT_TRUE(row.metrics || row.problems);
    EXPECT_FALSE(row.milliseconds || row.pareto);
  };
  EvaluationStep last;
  listener.step = [&](const EvaluationStep& step) {
    EXPECT_GE(step.done, last.done);
    EXPECT_LT(step.done, step.of);
    last = step;
    return true;
  };
  const auto report = evaluated(
      box, evaluationOf(R"("variants": [{"camera": {"node": "nobody"}}, {}, {"shadow": {"enabled": false}}])"),
      listener);
  ASSERT_TRUE(report);
  EXPECT_EQ(told, (std::vector<std::size_t>{0, 2, 1}));
  EXPECT_EQ(last.of, 1 + 1 + 1 + 2);
  EXPECT_EQ(last.done, last.of - 1);
  EXPECT_EQ(report->rows[0].problems->front().pointer, "/camera/node");
  EXPECT_EQ(report->rows[0].pareto, false);
  EXPECT_FALSE(report->rows[0].metrics || report->rows[2].metrics);
  EXPECT_EQ(report->rows[1].pareto, true);
}

TEST(Evaluate, ASpecThatTheSceneCanNotMeetIsTheRequestsProblem) {
  const auto report = evaluated(testing::generatedScene("box_on_plane"),
                                evaluationOf(R"("sweep": "techniques")", R"({"camera": {"node": "nobody"}})"));
  ASSERT_FALSE(report);
  EXPECT_EQ(report.problems()[0].pointer, "/spec/camera/node");
}

TEST(Evaluate, H6_ShimmerIsMeasuredAlongAPathOfSmallSteps) {
  const ScenePtr row = testing::generatedScene("long_row");
  const auto report = evaluated(row, evaluationOf(R"("path": {"step": [0.013, 0, 0.007], "frames": 8}, "variants": [
        {"shadow": {"technique": "shadowMap", "stabilization": "none"}},
        {"shadow": {"technique": "shadowMap", "stabilization": "projectionSnapping", "depthRange": {"mode": "manual", "min": 0, "max": 60}}}])"));
  ASSERT_TRUE(report) << report.problems()[0].detail;
  ASSERT_TRUE(report->rows[0].metrics && report->rows[1].metrics);
  EXPECT_GT(report->rows[0].metrics->shimmer.value(), 0);
  EXPECT_EQ(report->rows[1].metrics->shimmer.value(), 0);
}

TEST(Evaluate, H13_TilesThatAreKeptDoNotMakeLaterRoundsCheaper) {
  const ScenePtr box = testing::generatedScene("box_on_plane");
  const auto spec = decodeFrameSpec(testing::withMaps(Json::parse(kSpec)).dump());
  ASSERT_TRUE(spec);
  std::vector<std::uint64_t> casters;
  std::thread([&] { // a context of its own needs a thread of its own
    auto renderer = Renderer::create({.backend = testing::testedBackend()});
    ASSERT_TRUE(renderer);
    for (const TileUse use : {TileUse::kept, TileUse::drawnAnew, TileUse::drawnAnew, TileUse::kept}) {
      const auto frame = renderer->render(box, *spec, use);
      ASSERT_TRUE(frame);
      casters.push_back(frame->report.counts.casterTriangles);
    }
  })
      .join();
  ASSERT_EQ(casters.size(), 4u);
  EXPECT_GT(casters[0], 0u);
  EXPECT_EQ(casters[1], casters[0]);
  EXPECT_EQ(casters[2], casters[0]);
  EXPECT_EQ(casters[3], 0u) << "what the first left is still there";
}

} // namespace
} // namespace gnomon
