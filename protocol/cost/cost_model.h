#pragma once

#include <array>
#include <mutex>

#include "protocol/cost/frame_cost.h"
#include "protocol/report/frame_report.h"

namespace gnomon {

/// How long frames take on this machine, learned from those that are done: one factor for each part of a frame's work.
/// Frames of the past count less and less. Before the first frame the factors are those of two cores without a GPU. The
/// same frames in the same order give the same factors. Any thread.
class CostModel {
 public:
  /// `cost`: that of the frame. What an earlier frame spared this one (tiles, baked maps) teaches nothing.
  void learn(const FrameCost& cost, const FrameReport& report);

  /// Milliseconds by part, of a frame that finds nothing of earlier ones.
  FrameCost parts(const FrameCost& cost) const;
  /// Of the whole frame.
  double milliseconds(const FrameCost& cost) const;

 private:
  /// Sums over frames, each frame's weight less than that of the next.
  struct Seen {
    double milliseconds = 0;
    double work = 0;
  };

  mutable std::mutex mutex_;
  std::array<Seen, kFrameParts> seen_{};
};

} // namespace gnomon
