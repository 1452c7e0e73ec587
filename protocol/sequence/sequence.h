#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/base/result.h"
#include "protocol/evaluation/evaluation.h"
#include "protocol/json/json_codec.h"
#include "protocol/report/frame_report.h"
#include "protocol/report/replies.h"
#include "protocol/spec/frame_spec.h"

/// Many frames of one scene, drawn in order: a path of cameras, moving nodes, a day of the sun.
/// Rows of the fields: sequence_rows.h.
namespace gnomon {

// What a video says of itself at its end, as named texts: its SequenceReport, or the problem that ended it.
inline constexpr std::string_view kVideoReportTag = "GNOMON_REPORT";
inline constexpr std::string_view kVideoProblemTag = "GNOMON_PROBLEM";

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

/// A sequence that passed every check that needs no scene.
struct Sequence {
  Json spec{};                 ///< as it was written
  std::vector<Json> patches{}; ///< frames, or keys
  bool isKeyed = false;
  int count = 0; ///< frames, those before `first` included
  bool stable = true;
  double framesPerSecond = 30;
  int videoQuality = 75;
  int first = 0;
  Carried carried{}; ///< for frame `first`
};

/// A SequenceRequest from untrusted JSON, as strictly as decodeFrameSpec. Every frame must give a good spec; its
/// problems point into /frames/i, or into the key before it. The work is bounded by kLimits.maxSequenceSpecBytes.
/// `each` is called with every frame from `first` on, in order, without what is carried.
Result<Sequence> decodeSequence(std::string_view json, const std::function<void(const FrameSpec&)>& each = {});

/// Frame `index` as it is drawn after one that left `before`: it depends on nothing else. Any thread.
/// REQUIRES: 0 <= index < sequence.count.
FrameSpec frameSpec(const Sequence& sequence, int index, const Carried& before);

/// Pointer to frame `index` in the request: "/frames/17", "/keys/2".
std::string framePlace(const Sequence& sequence, int index);

/// What is carried, from untrusted JSON.
Result<Carried> decodeCarried(std::string_view json);

/// The ranges of a frame's lights with cascades.
Carried carriedOf(const FrameReport& report);

/// What the next frame takes from one that took `before` and has itself `own`: where a frame has no range of a light,
/// as with nothing in view, the one before stays.
Carried carriedAfter(const Carried& before, Carried own);

/// Gives each shadow the fit that moves by whole texels and the depth range of the frame before, except where
/// `written`, the spec as JSON, says `stabilization` or `depthRange` itself. A light without a range before it gets one
/// that every scene lies in, so that the first frame is fitted as all others are.
void makeStable(FrameSpec& spec, const Json& written, const Carried& before);

/// The frame as a video needs it: the first view alone, as it is seen, in 8 bits.
FrameSpec videoFrame(FrameSpec spec);

/// Whether all frames of a sequence have one size, as a video must.
class FrameSizes {
 public:
  /// Each frame in order, as decodeSequence calls for them.
  void see(const FrameSpec& spec);

  /// The first frame of another size, with its place. Views that choose their own size are found by their pictures.
  std::optional<Problem> problem(const Sequence& sequence) const;

 private:
  int width_ = 0;
  int height_ = 0;
  int seen_ = 0; ///< frames
  struct Other {
    int number, width, height;
  };
  std::optional<Other> other_{};
};

} // namespace gnomon
