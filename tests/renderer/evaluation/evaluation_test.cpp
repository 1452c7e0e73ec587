// What an evaluation decides without drawing: the front, medians, who shares a reference, and when to stop.
#include "protocol/evaluation/evaluation.h"

#include <gtest/gtest.h>

#include "protocol/spec/debug_light.h"
#include "renderer/evaluation/evaluate.h"
#include "renderer/evaluation/evaluation_measures.h"
#include "renderer/evaluation/world_points.h"
#include "renderer/render.h"
#include "tests/renderer/frame/squares.h"
#include "tests/renderer/made_environment.h"
#include "tests/support/glb_builder.h"

namespace gnomon {
namespace {

EvaluationRow row(double milliseconds, double misclassified) {
  EvaluationRow made;
  made.milliseconds = milliseconds;
  made.metrics.emplace();
  made.metrics->misclassified = misclassified;
  return made;
}

std::vector<bool> frontOf(std::vector<EvaluationRow> rows) {
  markPareto(rows);
  std::vector<bool> front;
  for (const EvaluationRow& each : rows) front.push_back(each.pareto.value());
  return front;
}

TEST(Pareto, NothingFasterAndNoMoreWrongIsBesideTheFront) {
  EXPECT_EQ(frontOf({row(10, 0.03), row(20, 0.02), row(20, 0.025), row(30, 0.02), row(40, 0), row(41, 0)}),
            (std::vector<bool>{true, true, false, false, true, false}));
}

TEST(Pareto, EqualRowsAreBothOnItAndRowsWithoutFiguresNever) {
  EvaluationRow untimed = row(1, 0);
  untimed.milliseconds.reset();
  EXPECT_EQ(frontOf({row(10, 0.1), row(10, 0.1), EvaluationRow{}, untimed}),
            (std::vector<bool>{true, true, false, false}));
  EXPECT_TRUE(frontOf({}).empty());
}

TEST(Pareto, ComparesTheErrorThatRowsAreRankedBy) {
  std::vector<EvaluationRow> rows{row(10, 0.01), row(20, 0.03)};
  rows[0].metrics->rms = 0.2;
  rows[1].metrics->rms = 0.1;
  markPareto(rows, RankedError::rms);
  EXPECT_TRUE(*rows[1].pareto);
  markPareto(rows);
  EXPECT_FALSE(*rows[1].pareto);
}

TEST(Median, IsTheMiddleWhateverTheOrder) {
  EXPECT_EQ(median({3}), 3);
  EXPECT_EQ(median({9, 1, 5}), 5);
  EXPECT_EQ(median({4, 1, 100, 2}), 3);
}

ScenePtr emptyScene() {
  Scene scene;
  scene.scenes.resize(1);
  return std::make_shared<const Scene>(std::move(scene));
}

RendererInfo processor() {
  return {.maxTextureSize = 16'384, .maxSamples = 8, .device = DeviceChoice::cpu};
}

std::vector<Subject> subjectsOf(const ScenePtr& scene, const char* request) {
  const auto evaluation = decodeEvaluation(request);
  EXPECT_TRUE(evaluation) << evaluation.problems()[0].detail;
  std::vector<Subject> subjects;
  for (std::size_t i = 0; i < evaluation->variants.size(); ++i) {
    auto subject = subjectOf(scene, evaluation->variants[i], i, processor());
    EXPECT_TRUE(subject) << i;
    if (subject) subjects.push_back(std::move(*subject));
  }
  return subjects;
}

TEST(EvaluationTruth, VariantsThatSeeTheSameShareAReference) {
  const ScenePtr scene = emptyScene();
  const auto groups = shareReferences(subjectsOf(scene, R"({"variants": [
      {}, {"shadow": {"filter": {"type": "hard"}, "cascadeCount": 1}}, {"width": 99}, {"exposure": 3},
      {"lights": [{"sun": {}, "intensity": 9}]}, {"lights": [{"sun": {"elevationDegrees": 10}}]},
      {"shadow": {"technique": "rayTraced"}, "width": 99}, {"shadow": {"blendedCasters": "threshold"}},
      {"camera": {"orbit": {"azimuthDegrees": 3}}}, {"views": ["depth"], "antialiasing": "none"}]})"));
  EXPECT_EQ(groups, (std::vector<std::vector<std::size_t>>{{0, 1, 3, 4, 9}, {2, 6}, {5}, {7}, {8}}));
}

TEST(EvaluationTruth, VariantsWithNodesElsewhereHaveReferencesOfTheirOwn) {
  const auto scene = loadScene(testing::plane().bundle());
  ASSERT_TRUE(scene);
  const auto groups = shareReferences(subjectsOf(*scene, R"({"variants": [
      {}, {"nodes": [{"node": 0, "translation": [1, 0, 0]}]}, {"nodes": [{"node": 0, "translation": [2, 0, 0]}]},
      {"nodes": [{"node": 0, "translation": [1, 0, 0]}], "exposure": 1}]})"));
  EXPECT_EQ(groups, (std::vector<std::vector<std::size_t>>{{0}, {1, 3}, {2}}));
}

TEST(EvaluationTruth, OnlyLightsThatCastAreMeasured) {
  const ScenePtr scene = emptyScene();
  const auto subjects = subjectsOf(scene, R"({"spec": {"lights": [
        {"sun": {}, "intensity": 0}, {"sun": {}, "shadow": {"enabled": false}}, {"sun": {}},
        {"type": "point", "position": [0, 1, 0]}, {"sun": {}, "shadow": {"strength": 0}}]}, "variants": [{}]})");
  ASSERT_EQ(subjects.size(), 1u);
  EXPECT_EQ(subjects[0].lights, (std::vector<int>{2, 3}));
}

TEST(EvaluationTruth, WhereNoLightCastsThereIsNothingToMeasure) {
  const ScenePtr scene = emptyScene();
  const auto evaluation = decodeEvaluation(R"({"variants": [{"shadow": {"enabled": false}}]})");
  const auto subject = subjectOf(scene, evaluation->variants[0], 0, processor());
  ASSERT_FALSE(subject);
  EXPECT_EQ(subject.problems()[0].pointer, "/shadow");
}

TEST(CameraPaths, StepsMoveTheEyeAndWhatItLooksAtAlikeAndAreNotSummedUp) {
  Camera start;
  start.lookAt = EyeTarget{{1e6, 2, 3}, {1e6, 2, 0}, {0, 1, 0}};
  start.perspective = Perspective{30, 0.1, std::nullopt};
  CameraPath path;
  path.step = Vec3{0.1, 0, -0.2};
  EXPECT_EQ(camerasAlong(path, start).size(), 16u);
  path.frames = 5;
  const auto cameras = camerasAlong(path, start);
  ASSERT_EQ(cameras.size(), 5u);
  EXPECT_EQ(cameras[0], start);
  EXPECT_EQ(cameras[4].lookAt->eye, (Vec3{1e6 + 4 * 0.1, 2, 3 - 4 * 0.2}));
  EXPECT_EQ(cameras[4].lookAt->target, (Vec3{1e6 + 4 * 0.1, 2, 0 - 4 * 0.2}));
  EXPECT_EQ(cameras[4].perspective, start.perspective);
  path = {};
  path.cameras = {start, Camera{}};
  EXPECT_EQ(camerasAlong(path, Camera{}), *path.cameras);
}

TEST(CameraPaths, StepsMoveAPose) {
  Camera start;
  start.pose = CameraPose{{{{1, 0, 0, 1e6}, {0, -1, 0, 2}, {0, 0, -1, 3}, {0, 0, 0, 1}}}, CameraAxes::opencv};
  start.intrinsics = Intrinsics{500, 500, 10, 20, 0.1, {}};
  CameraPath path;
  path.step = Vec3{0.1, 0, -0.2};
  path.frames = 5;
  Camera last = start;
  last.pose->worldFromCamera[0][3] = 1e6 + 4 * 0.1;
  last.pose->worldFromCamera[2][3] = 3 - 4 * 0.2;
  const auto cameras = camerasAlong(path, start);
  ASSERT_EQ(cameras.size(), 5u);
  EXPECT_EQ(cameras[0], start);
  EXPECT_EQ(cameras[4], last);
}

/// A frame of one stage for each variant: its index + 1 milliseconds.
struct Clockwork {
  std::vector<int> drawn; ///< widths, which tell the variants apart

  DrawFrame draw() {
    return [this](const FrameSpec& spec) -> Result<Frame> {
      drawn.push_back(spec.width);
      if (spec.width == 3) return Problem{ProblemCode::unsupportedFeature, "/shadow", "Not this one.", "", ""};
      if (spec.width == 4) return Problem{ProblemCode::deadlineExceeded, "", "Too late.", "", ""};
      Frame frame;
      frame.report.stages = {{"shadow", static_cast<double>(drawn.size())}, {"shade", 1.0 * spec.width}};
      frame.report.memory = {1, 2, 4};
      return frame;
    };
  }
};

Evaluation widths(int count, int repeats) {
  Evaluation evaluation;
  evaluation.repeats = repeats;
  for (int i = 1; i <= count; ++i) {
    evaluation.variants.emplace_back();
    evaluation.variants.back().spec.width = i;
  }
  return evaluation;
}

TEST(EvaluationTimes, VariantsTakeTurnsAndTheFirstRoundDoesNotCount) {
  Clockwork clock;
  EvaluationSteps steps({}, 8);
  const std::vector<std::size_t> both{0, 1};
  const auto times = timeVariants(widths(2, 3), both, clock.draw(), steps);
  ASSERT_TRUE(times);
  EXPECT_EQ(clock.drawn, (std::vector<int>{1, 2, 1, 2, 1, 2, 1, 2}));
  EXPECT_EQ((*times)[0].milliseconds, 5 + 1); // of the frames 3 5 7
  EXPECT_EQ((*times)[1].milliseconds, 6 + 2); // of the frames 4 6 8
  EXPECT_EQ((*times)[1].stages[0].stage, "shadow");
  EXPECT_EQ((*times)[1].stages[0].milliseconds, 6);
  EXPECT_EQ((*times)[0].memoryBytes, 7u);
}

TEST(EvaluationTimes, AVariantThatFailsIsLeftOutAndNoOneElse) {
  Clockwork clock;
  int last = 0;
  const EvaluationListener listener{[&](const EvaluationStep& step) {
                                      last = step.done;
                                      return true;
                                    },
                                    {}};
  EvaluationSteps steps(listener, 9);
  const std::vector<std::size_t> all{0, 1, 2};
  const auto times = timeVariants(widths(3, 2), all, clock.draw(), steps);
  ASSERT_TRUE(times);
  EXPECT_EQ(clock.drawn, (std::vector<int>{1, 2, 3, 1, 2, 1, 2}));
  EXPECT_EQ((*times)[2].problems[0].pointer, "/shadow");
  EXPECT_TRUE((*times)[0].problems.empty());
  EXPECT_EQ(last, 8) << "told before the last of 9";
}

/// Frames of nothing but light, of `lights` lights. Those of exposure 3 cannot be drawn from the debug light `failing`
/// on.
DrawFrame litFrames(std::size_t lights, int failing) {
  return [=](const FrameSpec& spec) -> Result<Frame> {
    if (spec.exposure == 3 && debugLightIndex(spec.debug) >= failing) {
      return Problem{ProblemCode::unsupportedFeature, "/shadow", "Not this one.", "", ""};
    }
    const auto pixels = static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height);
    Frame frame;
    frame.report.lights.resize(lights);
    frame.images.emplace_back().image.pixels = std::vector<float>(pixels, 1.0f);
    return frame;
  };
}

TEST(EvaluationErrors, AreReadFromTheMapsThatTheFrameHasWithItsOwnAntialiasing) {
  const ScenePtr scene = emptyScene();
  const auto evaluation =
      decodeEvaluation(R"({"repeats": 1, "spec": {"width": 16, "height": 16, "lights": [{"sun": {}}]},
      "variants": [{"antialiasing": "none"}, {"antialiasing": "msaa4x"}, {"shadow": {"strength": 0.5}}]})");
  ASSERT_TRUE(evaluation);
  std::vector<FrameSpec> drawn;
  const DrawFrame draw = [&](const FrameSpec& spec) {
    drawn.push_back(spec);
    return litFrames(1, 0)(spec);
  };
  ASSERT_TRUE(evaluate(scene, *evaluation, processor(), {draw, {}}));
  ASSERT_EQ(drawn.size(), 3u + 3 * 2);
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    EXPECT_EQ(drawn[i].antialiasing, i % 3 == 0 ? Antialiasing::none : Antialiasing::msaa4x) << i;
    EXPECT_EQ(drawn[i].views, std::vector{i < 3 ? View::shadow : View::color}) << i;
  }
}

TEST(EvaluationErrors, AreHeldAgainstTheEnvironmentThatTheRendererHas) {
  auto scene = std::make_shared<Scene>(*testing::squares());
  const auto file =
      std::make_shared<const EnvironmentFile>(testing::hdrFile(16, [](const glm::dvec3&) { return glm::dvec3(1); }));
  scene->environmentFiles.emplace("even.hdr", file);
  const auto evaluation = decodeEvaluation(R"({"repeats": 1, "variants": [{}],
      "spec": {"width": 16, "height": 16, "camera": {"eye": [0, 5, 0.1], "target": [0, 0, 0]},
               "environment": {"file": "even.hdr", "shadows": "rays"}, "debug": {"light": "environment"}}})");
  ASSERT_TRUE(evaluation);
  const auto rmsBy = [&](const std::shared_ptr<EnvironmentCache>& environments) {
    const auto report = evaluate(scene, *evaluation, processor(), {litFrames(1, 0), {}, environments});
    EXPECT_TRUE(report && report->rows[0].metrics);
    return report && report->rows[0].metrics ? report->rows[0].metrics->rms : -1.0;
  };
  EXPECT_GT(rmsBy(std::make_shared<EnvironmentCache>()), 0.01) << "the smaller square hides some of it";
  const auto known = std::make_shared<EnvironmentCache>();
  SplitEnvironment above{{32, 16, std::vector<glm::vec3>(32 * 16)}, {}}; // from the horizon, where nothing is hidden
  for (std::size_t x = 0; x < 32; ++x) above.map.texels[7 * 32 + x] = glm::vec3(1);
  ASSERT_TRUE(known->get(file, SunExtraction::auto_, above));
  EXPECT_LT(rmsBy(known), 0.5 * rmsBy(std::make_shared<EnvironmentCache>()));
}

TEST(EvaluationSteps, AreAllFinishedWhicheverLightAVariantFailsAt) {
  const ScenePtr scene = emptyScene();
  const auto evaluation = decodeEvaluation(R"({"repeats": 2, "variants": [{"exposure": 3}, {}],
      "spec": {"width": 16, "height": 16, "lights": [{"sun": {}}, {"sun": {}}, {"sun": {}}]}})");
  ASSERT_TRUE(evaluation);
  for (const int failing : {0, 1, 2, 3}) {
    EvaluationStep last;
    const EvaluationListener listener{[&](const EvaluationStep& step) {
                                        last = step;
                                        return true;
                                      },
                                      {}};
    const auto report = evaluate(scene, *evaluation, processor(), {litFrames(3, failing), {}}, listener);
    ASSERT_TRUE(report) << report.problems()[0].detail;
    EXPECT_EQ(report->rows[0].problems.has_value(), failing < 3) << failing;
    EXPECT_TRUE(report->rows[1].metrics && report->rows[1].milliseconds) << failing;
    EXPECT_EQ(last.of, 1 + 2 * (3 + 1 + 2));
    EXPECT_EQ(last.done, last.of - 1) << "told before the last, which is drawn; failing at " << failing;
  }
}

TEST(EvaluationTimes, ADeadlineEndsItAll) {
  Clockwork clock;
  EvaluationSteps steps({}, 12);
  const std::vector<std::size_t> all{0, 3, 1};
  const auto times = timeVariants(widths(4, 2), all, clock.draw(), steps);
  ASSERT_FALSE(times);
  EXPECT_EQ(times.problems()[0].code, ProblemCode::deadlineExceeded);
  EXPECT_EQ(clock.drawn.size(), 2u);
}

TEST(EvaluationTimes, WhoAsksToStopIsObeyedBeforeTheNextFrame) {
  Clockwork clock;
  const EvaluationListener listener{[&](const EvaluationStep& step) { return step.done < 3; }, {}};
  EvaluationSteps steps(listener, 8);
  const std::vector<std::size_t> both{0, 1};
  const auto times = timeVariants(widths(2, 3), both, clock.draw(), steps);
  ASSERT_FALSE(times);
  EXPECT_EQ(times.problems()[0].code, ProblemCode::unavailable);
  EXPECT_EQ(clock.drawn.size(), 3u);
}

} // namespace
} // namespace gnomon
