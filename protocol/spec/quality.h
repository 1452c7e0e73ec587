#pragma once

#include <optional>
#include <string>
#include <vector>

#include "protocol/spec/shadow_options.h"

namespace gnomon {

/// What the shadows of a frame shall be, instead of how: exactly one of the two.
struct Quality {
  std::optional<double> maxError{}; ///< share of misclassified receivers, 0..1: the cheapest settings that hold it
  std::optional<double> maxMilliseconds{}; ///< of a whole warm frame: the most exact settings that fit into it

  bool operator==(const Quality&) const = default;
};

/// Settings that were tried, and what they reached on this view.
struct QualityTrial {
  std::string settings{}; ///< a short name, e.g. "shadowMap hard 4 x 1024"
  Shadow shadow{};        ///< what every light that casts is given
  Atlas atlas{};
  double milliseconds = 0; ///< of a whole warm frame, median, without encoding
  double error = 0;        ///< share of misclassified receivers
};

/// How a target was met.
struct QualityReport {
  bool met = false;     ///< false = nothing reaches the target, and `chosen` is the best there is
  bool cached = false;  ///< chosen for an earlier frame of this scene and kind of view; nothing was tried
  std::size_t chosen{}; ///< index into `tried`
  std::vector<QualityTrial> tried{};
};

} // namespace gnomon
