#include "server/evaluations/settle_quality.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "protocol/json/json_codec.h"
#include "renderer/render.h"
#include "server/http/reply.h"

namespace gnomon {
namespace {

constexpr std::size_t kMostChoices = 1024; ///< a few kilobytes each

/// Equal for frames that one choice serves.
std::string keyOf(const std::string& sceneId, const std::string& viewClass, FrameSpec spec) {
  spec.camera = Camera{};
  return sceneId + "\n" + viewClass + "\n" + jsonText(toJson(spec));
}

} // namespace

std::optional<QualityReport> QualityChoices::find(const std::string& key) {
  const std::lock_guard lock(mutex_);
  const auto found =
      std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) { return entry.key == key; });
  if (found == entries_.end()) {
    return std::nullopt;
  }
  entries_.splice(entries_.begin(), entries_, found);
  return found->report;
}

void QualityChoices::keep(const std::string& key, const QualityReport& report) {
  const std::lock_guard lock(mutex_);
  entries_.remove_if([&](const Entry& entry) { return entry.key == key; });
  entries_.push_front({key, report});
  if (entries_.size() > kMostChoices) {
    entries_.pop_back();
  }
}

Result<QualityReport> settleQuality(EvaluationContext& context, QualityChoices& choices, const LoadedScene& scene,
                                    const FrameSpec& spec, const std::function<bool()>& gone) {
  const auto deadline = Clock::now() + context.timeout;
  const auto views = viewClass(*scene.scene, spec);
  if (!views) {
    return views.problems();
  }
  const std::string key = keyOf(scene.summary.id, *views, spec);
  if (auto known = choices.find(key)) {
    known->cached = true;
    return *std::move(known);
  }
  auto report = chooseQuality(spec, [&](const Evaluation& evaluation) -> Result<EvaluationReport> {
    const auto run = EvaluationRun::start(context, scene, evaluation, deadline);
    if (!run) {
      return run.problems();
    }
    return (*run)->report(gone);
  });
  if (report) {
    choices.keep(key, *report);
  }
  return report;
}

} // namespace gnomon
