#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "protocol/base/result.h"

namespace gnomon {

/// How many cores' time a control group may use, from its settings; empty = no limit, or not readable.
/// `cpuMax`: the text of cgroup v2's cpu.max, "150000 100000" or "max 100000", in microseconds.
std::optional<double> coresOfCpuMax(std::string_view cpuMax);

/// The tightest limit of these control groups (control_groups.h), of version 1 or 2.
std::optional<double> coresGranted(const std::vector<std::filesystem::path>& groups);

/// Cores to keep busy: the machine's, or as many as this process is granted where that is fewer; at least 1.
int coresToUse();

// The only parallel loops of the program: each runs on as many threads as `coresToUse()` allows, and is cancelled with
// the calling thread's task (stop.h).

/// Runs `task`; whatever it starts in parallel (Embree's builds, for one) keeps to that number of threads too.
void onAllCores(const std::function<void()>& task);

/// Calls `each(first, last)` for pieces of 0..count of at most `size`, in parallel; returns when all are done. Which
/// pieces there are does not depend on the number of cores.
void forEachPiece(std::size_t count, std::size_t size, const std::function<void(std::size_t, std::size_t)>& each);

/// Calls `each(i)` for every i of 0..count, in parallel; returns when all are done.
void forEach(std::size_t count, const std::function<void(std::size_t)>& each);

/// The same of what may fail: the problems of all, in their order.
Status forEachOrProblems(std::size_t count, const std::function<Status(std::size_t)>& each);

} // namespace gnomon
