#include "server/dispatch/placement.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <vector>

#include "protocol/base/split_mix.h"

namespace gnomon {
namespace {

/// Workers by descending weight for this scene and all that are kin to it.
std::vector<std::size_t> preference(const Task& task, std::size_t workers) {
  const std::uint64_t seed = std::hash<std::string>()(task.affinityKey.empty() ? task.order.scene : task.affinityKey);
  std::vector<std::size_t> order(workers);
  for (std::size_t i = 0; i < workers; ++i) order[i] = i;
  const auto weight = [&](std::size_t worker) { return mixed(seed ^ mixed(worker + 1)); };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return weight(a) > weight(b); });
  return order;
}

bool mayTake(const WorkerView& worker, const Task& task) {
  const auto lane = static_cast<std::size_t>(task.lane);
  return worker.ready && !worker.reserved && worker.running[lane] < kPlaces[lane];
}

} // namespace

std::optional<std::size_t> placeFor(const Task& task, std::span<const WorkerView> workers) {
  if (task.holdsRenderer && workers.size() > 1) {
    const auto held = static_cast<std::size_t>(std::count_if(
        workers.begin(), workers.end(), [](const WorkerView& worker) { return worker.holdingRenderer > 0; }));
    if (held + 1 >= workers.size()) return std::nullopt;
  }
  const auto order = preference(task, workers.size());
  const auto idle = std::find_if(order.begin(), order.end(), [&](std::size_t worker) {
    return mayTake(workers[worker], task) && workers[worker].all() == 0;
  });
  if (idle != order.end()) return *idle;
  const auto preferred =
      std::find_if(order.begin(), order.end(), [&](std::size_t worker) { return workers[worker].ready; });
  if (preferred == order.end()) return std::nullopt;
  const WorkerView& first = workers[*preferred];
  if (mayTake(first, task) && (first.holdingRenderer == 0 || workers.size() == 1)) return *preferred;
  const auto unheld = std::find_if(order.begin(), order.end(), [&](std::size_t worker) {
    return mayTake(workers[worker], task) && workers[worker].holdingRenderer == 0;
  });
  if (first.holdingRenderer > 0 && unheld != order.end()) return *unheld;
  return std::nullopt;
}

std::optional<LonePlace> lonePlaceFor(const Task& task, std::span<const WorkerView> workers) {
  const auto order = preference(task, workers.size());
  std::optional<LonePlace> best;
  for (const std::size_t worker : order) {
    if (!workers[worker].ready) continue;
    if (workers[worker].all() == 0) return LonePlace{worker, true};
    if (!best) best = LonePlace{worker, false};
  }
  return best;
}

} // namespace gnomon
