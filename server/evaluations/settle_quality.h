#pragma once

#include <functional>
#include <list>
#include <mutex>
#include <optional>
#include <string>

#include "protocol/report/frame_report.h"
#include "server/evaluations/evaluation_run.h"

namespace gnomon {

/// Settings chosen for earlier frames with a target; the least recently used are dropped first. Any thread.
class QualityChoices {
 public:
  std::optional<QualityReport> find(const std::string& key);
  void keep(const std::string& key, const QualityReport& report);

 private:
  struct Entry {
    std::string key;
    QualityReport report;
  };

  std::mutex mutex_;
  std::list<Entry> entries_; ///< most recently used first
};

/// The settings that meet the target of `spec`: those of an earlier frame of this scene and class of views, or else
/// found by drawing and measuring many frames. Problems as an evaluation gives, with places in `spec`. `gone`: see
/// EvaluationRun::report.
Result<QualityReport> settleQuality(EvaluationContext& context, QualityChoices& choices, const LoadedScene& scene,
                                    const FrameSpec& spec, const std::function<bool()>& gone);

} // namespace gnomon
