#include "renderer/evaluation/evaluate.h"

#include <algorithm>

#include "protocol/json/json_codec.h"
#include "renderer/core/collect.h"
#include "renderer/evaluation/evaluation_measures.h"
#include "renderer/evaluation/world_points.h"
#include "renderer/resolve/resolve_ground.h"

namespace gnomon {

namespace {

std::optional<std::string> unlessEmpty(const std::string& text) {
  return text.empty() ? std::nullopt : std::optional(text);
}

void setProblems(EvaluationRow& row, const Problems& problems) {
  row.metrics.reset();
  row.problems.emplace();
  for (const Problem& problem : problems) {
    row.problems->push_back({std::string(problemName(problem.code)), problem.pointer, problem.detail,
                             unlessEmpty(problem.limit), unlessEmpty(problem.actual)});
  }
}

void reportRow(const EvaluationListener& listener, std::size_t index, const EvaluationRow& row) {
  if (listener.row) listener.row(index, row);
}

/// What a variant takes after its error is known: its path, one warm frame, and the timed ones.
int laterSteps(const Evaluation& evaluation) {
  return (evaluation.path ? 1 : 0) + 1 + evaluation.repeats;
}

int stepCount(const std::vector<Subject>& subjects, const Evaluation& evaluation) {
  int count = 0;
  for (const Subject& subject : subjects) count += static_cast<int>(subject.lights.size()) + laterSteps(evaluation);
  return count;
}

/// One run from beginning to end.
class Run {
 public:
  Run(const ScenePtr& scene, const Evaluation& evaluation, const RendererInfo& renderer, const EvaluationTools& tools,
      const EvaluationListener& listener)
      : evaluation_(evaluation),
        tools_(tools),
        listener_(listener),
        truth_(scene, evaluation.referenceSamples, tools.environments) {
    for (std::size_t i = 0; i < evaluation.variants.size(); ++i) {
      const Variant& variant = evaluation.variants[i];
      EvaluationRow& row = rows_.emplace_back();
      row.variant = variant.patch;
      row.name = variant.name;
      auto subject = subjectOf(scene, variant, i, renderer);
      if (!subject) {
        setProblems(row, subject.problems());
      } else if (evaluation.path && measuresEnvironment(*subject)) {
        setProblems(row, {{ProblemCode::unsupportedFeature, "/debug/light",
                           "Shimmer is measured of lights, not of the environment.", "no path, or a light", ""}});
      } else {
        subjects_.push_back(std::move(*subject));
      }
    }
  }

  Result<EvaluationReport> run(const RendererInfo& renderer) {
    const auto groups = shareReferences(subjects_);
    EvaluationSteps steps(listener_, stepCount(subjects_, evaluation_) + static_cast<int>(groups.size()));
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      if (rows_[i].problems) reportRow(listener_, i, rows_[i]);
    }
    for (const auto& group : groups) {
      if (const Status done = measureGroup(group, steps); !done) return done.problems();
    }
    if (const Status done = time(steps); !done) return done.problems();
    const bool shares = std::any_of(subjects_.begin(), subjects_.end(), measuresEnvironment);
    const RankedError rankedBy = shares ? RankedError::rms : RankedError::misclassified;
    markPareto(rows_, rankedBy);
    return EvaluationReport{std::move(rows_), rankedBy, truth_.report(), renderer};
  }

 private:
  Status measureGroup(const std::vector<std::size_t>& group, EvaluationSteps& steps) {
    const auto reference = truth_.trace(subjects_[group.front()], steps);
    if (!reference) return reference.problems();
    for (const std::size_t member : group) {
      const Subject& subject = subjects_[member];
      EvaluationRow& row = rows_[subject.index];
      auto metrics = measureSubject(subject, *reference, tools_.draw, steps);
      if (metrics && evaluation_.path) metrics = withShimmer(subject, *metrics, steps);
      if (!metrics && endsEvaluation(metrics.problems())) return metrics.problems();
      if (metrics) {
        row.metrics = *metrics;
      } else {
        setProblems(row, metrics.problems());
        steps.finish(laterSteps(evaluation_));
      }
      reportRow(listener_, subject.index, row);
    }
    return Done{};
  }

  Result<ErrorMetrics> withShimmer(const Subject& subject, ErrorMetrics metrics, EvaluationSteps& steps) {
    if (!steps.goOn(subject.index)) return EvaluationSteps::stopProblem();
    const std::vector<Camera> cameras = camerasAlong(*evaluation_.path, subject.frame.spec.camera);
    const auto shimmer = tools_.shimmer(evaluation_.variants[subject.index].spec, cameras,
                                        [&](double) { return steps.goOn(subject.index); });
    if (!shimmer) return shimmer.problems();
    metrics.shimmer = *shimmer;
    steps.finish();
    return metrics;
  }

  Status time(EvaluationSteps& steps) {
    std::vector<std::size_t> measured;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      if (rows_[i].metrics) measured.push_back(i);
    }
    auto times = timeVariants(evaluation_, measured, tools_.draw, steps);
    if (!times) return times.problems();
    for (std::size_t i = 0; i < measured.size(); ++i) {
      EvaluationRow& row = rows_[measured[i]];
      VariantTimes& each = (*times)[i];
      if (!each.problems.empty()) {
        setProblems(row, each.problems);
        continue;
      }
      row.milliseconds = each.milliseconds;
      row.stages = std::move(each.stages);
      row.memoryBytes = each.memoryBytes;
    }
    return Done{};
  }

  const Evaluation& evaluation_;
  const EvaluationTools& tools_;
  const EvaluationListener& listener_;
  Truth truth_;
  std::vector<EvaluationRow> rows_;
  std::vector<Subject> subjects_;
};

} // namespace

Result<EvaluationReport> evaluate(const ScenePtr& scene, const Evaluation& evaluation, const RendererInfo& renderer,
                                  const EvaluationTools& tools, const EvaluationListener& listener) {
  ProblemList problems;
  const ScenePtr posed = collect(stagedScene(scene, evaluation.spec), problems).value_or(scene);
  resolveFrame(*posed, evaluation.spec, problems);
  if (!problems.empty()) return placedAt("/spec", std::move(problems).take());
  return Run(scene, evaluation, renderer, tools, listener).run(renderer);
}

namespace {

bool measured(const EvaluationRow& row) {
  return row.milliseconds && row.metrics;
}

bool beats(const EvaluationRow& a, const EvaluationRow& b, RankedError by) {
  const double timeA = *a.milliseconds, timeB = *b.milliseconds;
  const double errorA = errorOf(*a.metrics, by), errorB = errorOf(*b.metrics, by);
  return timeA <= timeB && errorA <= errorB && (timeA < timeB || errorA < errorB);
}

} // namespace

void markPareto(std::vector<EvaluationRow>& rows, RankedError by) {
  for (EvaluationRow& row : rows) {
    row.pareto = measured(row) && std::none_of(rows.begin(), rows.end(), [&](const EvaluationRow& other) {
                   return measured(other) && beats(other, row, by);
                 });
  }
}

} // namespace gnomon
