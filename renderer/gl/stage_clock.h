#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "protocol/report/frame_report.h"

namespace gnomon::gl {

/// Wall time of stages that follow each other. Begins with the first stage; each stage ends when the GPU is done.
class StageClock {
 public:
  StageClock() : begin_(std::chrono::steady_clock::now()) {}

  /// Waits for the GPU and books the time since the last stage's end. A name met again adds to its first entry.
  void finish(std::string stage);
  /// The stages so far, in the order in which they first ended; the clock is then as if new.
  std::vector<StageTime> take();

 private:
  std::chrono::steady_clock::time_point begin_;
  std::vector<StageTime> stages_;
};

} // namespace gnomon::gl
