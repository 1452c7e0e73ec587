#include "renderer/core/parallel.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <sstream>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <thread>
#include <utility>
#include <vector>

#include "renderer/core/control_groups.h"
#include "renderer/core/stop.h"

namespace gnomon {
namespace {

std::string textOf(const std::filesystem::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::optional<double> limitOf(const std::filesystem::path& group) {
  if (const auto cores = coresOfCpuMax(textOf(group / "cpu.max"))) return cores;
  return coresOfCpuMax(textOf(group / "cpu.cfs_quota_us") + " " + textOf(group / "cpu.cfs_period_us"));
}

} // namespace

std::optional<double> coresOfCpuMax(std::string_view cpuMax) {
  std::istringstream in{std::string(cpuMax)};
  double quota = 0;
  double period = 0;
  if (!(in >> quota >> period) || quota <= 0 || period <= 0) return std::nullopt; // "max", or -1 in version 1
  return quota / period;
}

std::optional<double> coresGranted(const std::vector<std::filesystem::path>& groups) {
  std::optional<double> least;
  for (const std::filesystem::path& group : groups) {
    if (const auto cores = limitOf(group); cores && (!least || *cores < *least)) least = cores;
  }
  return least;
}

int coresToUse() {
  const int machine = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const auto granted = coresGranted(controlGroups("cpu"));
  return granted && *granted < machine ? std::max(1, static_cast<int>(std::ceil(*granted))) : machine;
}

void onAllCores(const std::function<void()>& task) {
  // Callers have slots of their own: without them a bake and its helpers fill the arena, and a frame waits to its end.
  constexpr int kCallers = 8;
  static tbb::task_arena arena(coresToUse() - 1 + kCallers, kCallers);
  Stop* const stop = Stop::current();
  // A thread that waits for its own pieces takes none of another task's, which may be long and can't be stopped by it.
  arena.execute([&] {
    tbb::this_task_arena::isolate([&] {
      const CancellationScope scope(stop);
      task();
    });
  });
}

void forEachPiece(std::size_t count, std::size_t size, const std::function<void(std::size_t, std::size_t)>& each) {
  const std::size_t pieces = (count + size - 1) / size;
  if (pieces == 0) return;
  if (pieces == 1) {
    stopIfAsked();
    each(0, count);
    return;
  }
  Stop* const stop = Stop::current();
  onAllCores([&] {
    tbb::parallel_for(std::size_t{0}, pieces, [&](std::size_t piece) {
      const CancellationScope scope(stop);
      stopIfAsked();
      each(piece * size, std::min(count, (piece + 1) * size));
    });
  });
}

void forEach(std::size_t count, const std::function<void(std::size_t)>& each) {
  forEachPiece(count, 1, [&](std::size_t i, std::size_t) { each(i); });
}

Status forEachOrProblems(std::size_t count, const std::function<Status(std::size_t)>& each) {
  std::vector<Problems> found(count);
  forEach(count, [&](std::size_t i) {
    if (const Status done = each(i); !done) found[i] = done.problems();
  });
  ProblemList all;
  for (Problems& problems : found) {
    for (Problem& problem : problems) all.add(std::move(problem));
  }
  if (all.empty()) return Done{};
  return std::move(all).take();
}

} // namespace gnomon
