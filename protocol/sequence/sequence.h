#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/evaluation/evaluation.h"
#include "protocol/report/frame_report.h"
#include "protocol/report/replies.h"
#include "protocol/spec/frame_spec.h"

/// Many frames of one scene, drawn in order: a path of cameras, moving nodes, a day of the sun.
/// Rows of the fields: sequence_rows.h.
namespace gnomon {

// What a video says of itself at its end, as named texts: its SequenceReport, or the problem that ended it.
inline constexpr std::string_view kVideoReportTag = "GNOMON_REPORT";
inline constexpr std::string_view kVideoProblemTag = "GNOMON_PROBLEM";

/// The view depths that one light's cascades cover.
struct CarriedRange {
  int light = 0;
  double near = 0;
  double far = 0;

  bool operator==(const CarriedRange&) const = default;
};

/// All that a frame takes from the one before it.
struct Carried {
  std::vector<CarriedRange> depthRanges{};

  bool operator==(const Carried&) const = default;
};

/// A sequence as it is asked for; exactly one of `frames` and `keys`.
struct SequenceRequest {
  FrameSpec spec{};
  std::optional<std::vector<SpecPatch>> frames{};
  std::optional<std::vector<SpecPatch>> keys{};
  std::optional<int> count{};
  bool stable = true;
  double framesPerSecond = 30;
  int videoQuality = 75;
  int first = 0;
  std::optional<Carried> carried{};
};

/// The data of an event `frame`.
struct SequenceFrame {
  int index = 0;
  int of = 0;
  std::vector<ImageReply> images{};
  Carried carried{};
  std::vector<StageTime> stages{};
};

/// What one frame took.
struct SequenceFrameReport {
  int index = 0;
  double milliseconds = 0;
  std::vector<StageTime> stages{};
};

/// What a sequence took and leaves behind.
struct SequenceReport {
  std::vector<SequenceFrameReport> frames{};
  double milliseconds = 0;
  double framesPerSecond = 0;
  Carried carried{};
  std::vector<std::string> warnings{};
  RendererInfo renderer{};
};

} // namespace gnomon
