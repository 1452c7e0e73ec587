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
namespace gnomon {

// What a video says of itself at its end, as named texts: its SequenceReport, or the problem that ended it.
inline constexpr std::string_view kVideoReportTag = "GNOMON_REPORT";
inline constexpr std::string_view kVideoProblemTag = "GNOMON_PROBLEM";

/// The view depths that one light's cascades cover.
struct CarriedRange {
  int light = 0;   ///< index into the lights of the frame
  double near = 0; ///< metres
  double far = 0;  ///< metres, > near

  bool operator==(const CarriedRange&) const = default;
};

/// All that a frame takes from the one before it.
struct Carried {
  std::vector<CarriedRange> depthRanges{}; ///< ascending by light

  bool operator==(const Carried&) const = default;
};

/// A sequence as it is asked for; exactly one of `frames` and `keys`.
struct SequenceRequest {
  FrameSpec spec{};                               ///< what all frames begin with; names no target
  std::optional<std::vector<SpecPatch>> frames{}; ///< one frame each
  std::optional<std::vector<SpecPatch>> keys{};   ///< at least two; frames lie between them
  std::optional<int> count{};                     ///< with `keys`: how many frames, at least two
  bool stable = true;                             ///< shadows don't crawl from frame to frame
  double framesPerSecond = 30;                    ///< of a video, or of one that is made of the frames
  int videoQuality = 75;                          ///< of a video: 1 smallest .. 100 best
  int first = 0;                                  ///< index of the first frame that is drawn
  std::optional<Carried> carried{};               ///< from the frame before it
};

/// The data of an event `frame`.
struct SequenceFrame {
  int index = 0;
  int of = 0; ///< frames of the sequence
  std::vector<ImageReply> images{};
  Carried carried{}; ///< for the next frame
  std::vector<StageTime> stages{};
};

/// What one frame took.
struct SequenceFrameReport {
  int index = 0;
  double milliseconds = 0; ///< from its beginning to its pictures, while its neighbours were worked on, too
  std::vector<StageTime> stages{};
};

/// What a sequence took and leaves behind.
struct SequenceReport {
  std::vector<SequenceFrameReport> frames{}; ///< those that were drawn, in order
  double milliseconds = 0;                   ///< of all of it
  double framesPerSecond = 0;                ///< as it was asked for
  Carried carried{};                         ///< from the last frame, for a sequence that goes on from there
  std::vector<std::string> warnings{};       ///< of all frames, each once; the first few
  RendererInfo renderer{};
};

} // namespace gnomon
