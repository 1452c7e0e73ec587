#pragma once

#include <chrono>

namespace gnomon {

/// Wall time since then.
inline double millisecondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

} // namespace gnomon
