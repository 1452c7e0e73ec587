#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "protocol/report/error_metrics.h"
#include "protocol/report/frame_report.h"
#include "protocol/report/replies.h"
#include "protocol/spec/frame_spec.h"

/// Speed against error: a frame's settings and variants of them, each measured against rays.
namespace gnomon {

/// Variants that the server knows by name.
enum class Sweep { techniques, filters, sizes, all };

/// What a variant changes in a FrameSpec: a JSON merge patch (RFC 7396) as text. Always a JSON object.
struct SpecPatch {
  std::string json = "{}";

  bool operator==(const SpecPatch&) const = default;
};

/// Where the camera goes so that shimmer shows; exactly one of `cameras` and `step`.
struct CameraPath {
  std::optional<std::vector<Camera>> cameras{}; ///< one a frame, at least two
  std::optional<Vec3> step{};                   ///< metres that each variant's own camera moves from frame to frame
  std::optional<int> frames{};                  ///< with `step`: how many, at least two; absent = 16
};

/// An evaluation as it is asked for; exactly one of `variants` and `sweep`.
struct EvaluationRequest {
  FrameSpec spec{};                                 ///< what all variants begin with; names no target
  std::optional<std::vector<SpecPatch>> variants{}; ///< one row each
  std::optional<Sweep> sweep{};
  int repeats = 5;                  ///< timed frames of a variant
  int referenceSamples = 256;       ///< rays a pixel of the reference towards a light that has a size; 1..1024
  std::optional<CameraPath> path{}; ///< present = shimmer is measured along it
};

/// One variant, ready to be drawn.
struct Variant {
  SpecPatch patch{};
  std::string name{}; ///< a short one for people
  FrameSpec spec{};
};

/// An evaluation that passed every check that needs no scene.
struct Evaluation {
  FrameSpec spec{};
  std::vector<Variant> variants{}; ///< at least one
  int repeats = 5;
  int referenceSamples = 256;
  std::optional<CameraPath> path{};
};

/// Why a variant could not be measured; Problem in JSON.
struct VariantProblem {
  std::string code{};
  std::string pointer{}; ///< into the variant's whole spec
  std::string detail{};
  std::optional<std::string> limit{};
  std::optional<std::string> actual{};
};

/// One variant: its speed and its error, or why there are none.
struct EvaluationRow {
  SpecPatch variant{};
  std::string name{};
  /// Of a whole warm frame, its tiles drawn anew, not encoded: the median. Absent until it is timed.
  std::optional<double> milliseconds{};
  std::vector<StageTime> stages{}; ///< medians, each by itself
  std::uint64_t memoryBytes = 0;   ///< on the device, the scene's own included
  std::optional<ErrorMetrics> metrics{};
  std::optional<bool> pareto{}; ///< true = no other row is faster and misclassifies no more; absent until all are timed
  std::optional<std::vector<VariantProblem>> problems{}; ///< present where it could not be measured
};

/// The truth that the rows were held against.
struct ReferenceReport {
  double milliseconds = 0;      ///< of tracing
  double buildMilliseconds = 0; ///< of sorting the scene for rays, before
  int samples = 0;              ///< rays a pixel towards lights that have a size
  int frames = 0;               ///< traced ones: variants that see the same from the same place share one
};

struct EvaluationReport {
  std::vector<EvaluationRow> rows{}; ///< in the order of the variants
  ReferenceReport reference{};
  RendererInfo renderer{};
};

/// How far an evaluation has come.
struct EvaluationStep {
  int done = 0;    ///< frames, references and paths that are finished
  int of = 0;      ///< of all; fewer may come where a variant fails
  int variant = 0; ///< index of the one that is worked on
};

} // namespace gnomon
