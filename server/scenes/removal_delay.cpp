#include "server/scenes/removal_delay.h"

#include <string>

#include "server/system/log.h"

namespace gnomon {

bool RemovalDelay::mayGo(std::size_t old, std::size_t all, Clock::time_point now) {
  constexpr int kShare = 10;
  if (old * kShare <= all) {
    until_.reset();
    return true;
  }
  if (!until_) {
    until_ = now + std::chrono::milliseconds(age_) / kShare;
    logEvent("store", std::to_string(old) + " of " + std::to_string(all) + " scenes were not used for " +
                          std::to_string(age_.count()) +
                          " s (--store-age), or the clock was set forward. They are removed a tenth of that later.");
    return false;
  }
  return now >= *until_;
}

} // namespace gnomon
