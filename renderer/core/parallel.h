#pragma once

#include <cstddef>
#include <functional>

namespace gnomon {

// The only parallel loops of the program: each runs on as many threads as `coresToUse()` allows, and no more.

/// Runs `task`; whatever it starts in parallel (Embree's builds, for one) keeps to that number of threads too.
void onAllCores(const std::function<void()>& task);

/// Calls `each(first, last)` for pieces of 0..count of at most `size`, in parallel; returns when all are done. Which
/// pieces there are does not depend on the number of cores.
void forEachPiece(std::size_t count, std::size_t size, const std::function<void(std::size_t, std::size_t)>& each);

/// Calls `each(i)` for every i of 0..count, in parallel; returns when all are done.
void forEach(std::size_t count, const std::function<void(std::size_t)>& each);

} // namespace gnomon
