#pragma once

#include <array>
#include <cstddef>
#include <numeric>
#include <optional>
#include <span>

#include "server/dispatch/task.h"

namespace gnomon {

/// How many tasks of each lane one worker has at once. Two interactive ones: while one is drawn, the other one's scene
/// is loaded or its picture encoded. Two frames of sequences, for the same reason.
inline constexpr std::array<std::size_t, kLanes> kPlaces{2, 1, 2, 2};

/// What placing must know of a worker.
struct WorkerView {
  bool ready = false;
  std::array<std::size_t, kLanes> running{}; ///< tasks of each lane
  std::size_t holdingRenderer = 0;           ///< tasks that hold its renderer
  bool reserved = false;                     ///< for a task that must be alone there

  std::size_t all() const { return std::accumulate(running.begin(), running.end(), std::size_t{0}); }
};

/// The worker that a task goes to now; nothing = it waits. Tasks of a scene go to the worker that has the scene, by
/// highest random weight (Thaler and Ravishankar, "Using name-based mappings to increase hit rates", 1998), so that few
/// scenes move when a worker is gone. Where that one has any task and another has none, to the other: loading the scene
/// once more takes a known time, and the task before may take minutes. A task that holds the renderer leaves at least
/// one of several workers to the others.
std::optional<std::size_t> placeFor(const Task& task, std::span<const WorkerView> workers);

/// The worker where a task is to run alone, and whether that is free for it; nothing while no worker is ready.
struct LonePlace {
  std::size_t worker = 0;
  bool free = false;
};
std::optional<LonePlace> lonePlaceFor(const Task& task, std::span<const WorkerView> workers);

} // namespace gnomon
