#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>

namespace gnomon {

/// Never set back, and the same in every process of the machine.
using Clock = std::chrono::steady_clock;

/// The time until a deadline as poll(2) takes it: rounded up, 0..60,000.
inline int millisecondsUntil(Clock::time_point deadline) {
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
  return static_cast<int>(std::clamp<std::int64_t>(left, 0, 60'000));
}

} // namespace gnomon
