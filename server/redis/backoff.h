#pragma once

#include <algorithm>
#include <chrono>

namespace gnomon::redis {

/// How long to leave a server alone after so many failures in a row, >= 1: from 50 ms on twice as long each time, up
/// to 5 s, and of that between half and all, so that many clients do not come at once. `random`: 0..1.
inline std::chrono::milliseconds backoffDelay(int failures, double random) {
  constexpr std::chrono::milliseconds kFirst{50};
  constexpr std::chrono::milliseconds kLongest{5'000};
  constexpr int kDoublings = 7; // more would pass the longest
  const auto whole = std::min(kFirst * (1 << std::clamp(failures - 1, 0, kDoublings)), kLongest);
  return std::chrono::milliseconds(static_cast<std::int64_t>(static_cast<double>(whole.count()) * (0.5 + random / 2)));
}

} // namespace gnomon::redis
