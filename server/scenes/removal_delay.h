#pragma once

#include <chrono>
#include <cstddef>
#include <optional>

#include "server/system/clock.h"

namespace gnomon {

/// A clock that was set forward makes everything old at once. Where one pass would remove more than a tenth of all
/// scenes, they stay for a tenth of the age more, by a clock that is never set, and the log says so: they may be used,
/// or the clock set right. One thread.
class RemovalDelay {
 public:
  /// `age`: at which scenes go.
  explicit RemovalDelay(std::chrono::seconds age) : age_(age) {}

  /// Whether a pass that found `old` of `all` scenes to be too old may remove them now.
  bool mayGo(std::size_t old, std::size_t all, Clock::time_point now);

 private:
  const std::chrono::seconds age_;
  std::optional<Clock::time_point> until_; ///< since more than a tenth is old; nothing = it is less
};

} // namespace gnomon
