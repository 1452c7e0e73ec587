#pragma once

#include <atomic>
#include <chrono>
#include <semaphore>
#include <vector>

#include "protocol/spec/limits.h"
#include "server/evaluations/evaluation_run.h"
#include "server/frames/render_queue.h"
#include "server/http/reply.h"
#include "server/http/request_body.h"
#include "server/scenes/scene_store.h"

namespace gnomon {

/// What the handlers share. Outlives them; each part may be used by any thread.
struct Services {
  SceneStore& store;
  RenderQueue& queue;
  ByteBudget& frameMemory; ///< of pictures that are being drawn or encoded
  Limits limits;
  std::chrono::milliseconds requestTimeout{60'000}; ///< from the handler's start to the frame
  std::vector<StaticFile> page;
  EvaluationContext evaluations;
  QualityChoices choices;
  std::counting_semaphore<> plans{2}; ///< how many more may be made at once: each takes memory by the picture's size
  std::atomic<bool> draining = false; ///< true from the first signal on; readyz reports it
};

} // namespace gnomon
