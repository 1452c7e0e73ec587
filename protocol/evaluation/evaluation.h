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
/// Rows of the fields: evaluation_rows.h.
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
  std::optional<std::vector<Camera>> cameras{};
  std::optional<Vec3> step{};
  std::optional<int> frames{};
};

/// An evaluation as it is asked for; exactly one of `variants` and `sweep`.
struct EvaluationRequest {
  FrameSpec spec{};
  std::optional<std::vector<SpecPatch>> variants{};
  std::optional<Sweep> sweep{};
  int repeats = 5;
  int referenceSamples = 256;
  std::optional<CameraPath> path{};
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
  std::string pointer{};
  std::string detail{};
  std::optional<std::string> limit{};
  std::optional<std::string> actual{};
};

/// One variant: its speed and its error, or why there are none.
struct EvaluationRow {
  SpecPatch variant{};
  std::string name{};
  std::optional<double> milliseconds{};
  std::vector<StageTime> stages{};
  std::uint64_t memoryBytes = 0;
  std::optional<ErrorMetrics> metrics{};
  std::optional<bool> pareto{};
  std::optional<std::vector<VariantProblem>> problems{};
};

/// The truth that the rows were held against.
struct ReferenceReport {
  double milliseconds = 0;
  double buildMilliseconds = 0;
  int samples = 0;
  int frames = 0;
};

struct EvaluationReport {
  std::vector<EvaluationRow> rows{};
  ReferenceReport reference{};
  RendererInfo renderer{};
};

/// How far an evaluation has come.
struct EvaluationStep {
  int done = 0;
  int of = 0;
  int variant = 0;
};

} // namespace gnomon
