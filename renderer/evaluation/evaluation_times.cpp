#include "renderer/evaluation/evaluation_times.h"

#include <algorithm>

#include "renderer/evaluation/evaluate.h"

namespace gnomon {
namespace {

/// Every frame's time of one stage.
struct StageSeries {
  std::string stage;
  std::vector<double> milliseconds;
};

/// A variant while its rounds go on.
struct Running {
  std::vector<double> whole;
  std::vector<StageSeries> stages;
  std::uint64_t memoryBytes = 0;
  Problems problems;
};

void add(const FrameReport& report, Running& running) {
  double whole = 0;
  for (const StageTime& stage : report.stages) {
    whole += stage.milliseconds;
    auto series = std::find_if(running.stages.begin(), running.stages.end(),
                               [&](const StageSeries& each) { return each.stage == stage.stage; });
    if (series == running.stages.end()) series = running.stages.insert(series, {stage.stage, {}});
    series->milliseconds.push_back(stage.milliseconds);
  }
  running.whole.push_back(whole);
  running.memoryBytes = report.memory.scene + report.memory.atlas + report.memory.targets;
}

VariantTimes timesOf(Running running) {
  VariantTimes times{0, {}, running.memoryBytes, std::move(running.problems)};
  if (!times.problems.empty()) return times;
  times.milliseconds = median(std::move(running.whole));
  for (StageSeries& series : running.stages) {
    times.stages.push_back({std::move(series.stage), median(std::move(series.milliseconds))});
  }
  return times;
}

} // namespace

Result<std::vector<VariantTimes>> timeVariants(const Evaluation& evaluation, std::span<const std::size_t> indices,
                                               const DrawFrame& draw, EvaluationSteps& steps) {
  std::vector<Running> all(indices.size());
  for (int round = 0; round <= evaluation.repeats; ++round) {
    for (std::size_t i = 0; i < indices.size(); ++i) {
      if (!all[i].problems.empty()) continue;
      if (!steps.goOn(indices[i])) return EvaluationSteps::stopProblem();
      const auto frame = draw(evaluation.variants[indices[i]].spec);
      if (!frame && endsEvaluation(frame.problems())) return frame.problems();
      if (!frame) {
        all[i].problems = frame.problems();
        steps.finish(evaluation.repeats + 1 - round);
        continue;
      }
      if (round > 0) add(frame->report, all[i]);
      steps.finish();
    }
  }
  std::vector<VariantTimes> times;
  for (Running& running : all) times.push_back(timesOf(std::move(running)));
  return times;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return (*middle + *std::max_element(values.begin(), middle)) / 2;
}

} // namespace gnomon
