#include "renderer/gl/stage_clock.h"

#include <algorithm>
#include <utility>

#include "renderer/gl/gl.h"

namespace gnomon::gl {

void StageClock::finish(std::string stage) {
  glFinish();
  const auto now = std::chrono::steady_clock::now();
  const double milliseconds = std::chrono::duration<double, std::milli>(now - std::exchange(begin_, now)).count();
  const auto same = std::ranges::find(stages_, stage, &StageTime::stage);
  if (same != stages_.end()) {
    same->milliseconds += milliseconds;
  } else {
    stages_.push_back({std::move(stage), milliseconds});
  }
}

std::vector<StageTime> StageClock::take() {
  begin_ = std::chrono::steady_clock::now();
  return std::exchange(stages_, {});
}

} // namespace gnomon::gl
