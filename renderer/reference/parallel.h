#pragma once

#include <cstddef>
#include <functional>

namespace gnomon {

/// Runs `task` so that what it starts side by side keeps the cores busy that this process may use, and no more.
void onAllCores(const std::function<void()>& task);

/// Calls `each(first, last)` for pieces of 0..count of at most `size`, side by side; returns when all are done. Which
/// pieces there are does not depend on the cores.
void forEachPiece(std::size_t count, std::size_t size, const std::function<void(std::size_t, std::size_t)>& each);

} // namespace gnomon
