#pragma once

#include <functional>

namespace gnomon {

/// Told how far a long task has come, 0..1, by one thread at a time; false asks it to stop. Empty = nobody listens.
using Progress = std::function<bool(double)>;

} // namespace gnomon
