#pragma once

#include <functional>

namespace gnomon {

/// Called with the progress of a long task, 0..1, by one thread at a time; false cancels it. Empty = not reported.
using Progress = std::function<bool(double)>;

} // namespace gnomon
