#pragma once

#include <mutex>
#include <optional>
#include <string>

#include "protocol/base/lru.h"
#include "protocol/report/frame_report.h"

namespace gnomon {

/// Settings chosen for earlier frames with a target, by what decides them; the least recently used are dropped first.
/// Any thread.
class QualityChoices {
 public:
  /// `key`: any text. Only its hash is kept.
  std::optional<QualityReport> find(const std::string& key);
  void keep(const std::string& key, const QualityReport& report);

 private:
  static constexpr std::size_t kMost = 1024; ///< a few hundred bytes each

  struct Entry {
    std::string hash;
    QualityReport report;
  };

  std::mutex mutex_;
  LruList<Entry> entries_;
};

} // namespace gnomon
