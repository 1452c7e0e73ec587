#pragma once

#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "protocol/base/lru.h"
#include "protocol/cost/frame_cost.h"

namespace gnomon {

/// What scenes bring to their frames, by id, as it was last read from their summaries; the longest unused are
/// forgotten. Any thread.
class KnownCounts {
 public:
  std::optional<SceneCounts> find(const std::string& id);
  void keep(const std::string& id, SceneCounts counts);
  bool forget(const std::string& id); ///< false where it was not known

 private:
  static constexpr std::size_t kMost = 1024;       ///< scenes, a few kilobytes each at most
  static constexpr std::size_t kMostLights = 1024; ///< more than a frame may have

  using Entry = std::pair<std::string, SceneCounts>;

  std::mutex mutex_;
  LruList<Entry> entries_;
};

} // namespace gnomon
