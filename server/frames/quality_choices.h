#pragma once

#include <list>
#include <mutex>
#include <optional>
#include <string>

#include "protocol/spec/quality.h"

namespace gnomon {

/// What was chosen for the targets of earlier frames, the least recently used forgotten first. Any thread.
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

} // namespace gnomon
