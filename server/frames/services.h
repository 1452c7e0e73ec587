#pragma once

#include <atomic>
#include <chrono>
#include <semaphore>
#include <vector>

#include "server/frames/quality_choices.h"
#include "server/frames/render_queue.h"
#include "server/http/byte_budget.h"
#include "server/http/static_file.h"
#include "server/scenes/scene_store.h"

namespace gnomon {

/// What the handlers work with. Outlives them all; each part may be used by any thread.
struct Services {
  SceneStore& store;
  RenderQueue& queue;
  Limits limits;
  std::chrono::milliseconds requestTimeout{60'000}; ///< from the handler's start to the frame
  std::size_t frameMemoryBytes = 4ull << 30;        ///< the whole of `frameBytes`
  ByteBudget frameBytes;                            ///< left for pictures that are drawn or encoded at once
  std::vector<StaticFile> page;
  std::chrono::milliseconds evaluationTimeout{600'000}; ///< from the handler's start to the report
  std::counting_semaphore<> evaluations{1};             ///< at once; one more is told to come again
  QualityChoices choices;
  std::counting_semaphore<> plans{2}; ///< made at once: each takes memory by the picture's size
  std::atomic<bool> draining = false; ///< true from the first signal on: readyz says so
};

} // namespace gnomon
