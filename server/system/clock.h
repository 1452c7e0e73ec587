#pragma once

#include <chrono>

namespace gnomon {

/// Never set back, and the same in every process of the machine.
using Clock = std::chrono::steady_clock;

} // namespace gnomon
