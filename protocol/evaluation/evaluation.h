#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/base/result.h"
#include "protocol/json/json_codec.h"
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

/// The error of a row that makes it better or worse than another.
enum class RankedError { misclassified, rms };

/// That figure.
inline double errorOf(const ErrorMetrics& metrics, RankedError by) {
  return by == RankedError::rms ? metrics.rms : metrics.misclassified;
}

/// The truth that the rows were held against.
struct ReferenceReport {
  double milliseconds = 0;
  double buildMilliseconds = 0;
  int samples = 0;
  int frames = 0;
};

struct EvaluationReport {
  std::vector<EvaluationRow> rows{};
  RankedError rankedBy = RankedError::misclassified;
  ReferenceReport reference{};
  RendererInfo renderer{};
};

/// How far an evaluation has come.
struct EvaluationStep {
  int done = 0;
  int of = 0;
  int variant = 0;
};

/// An EvaluationRequest from untrusted JSON, as strictly as decodeFrameSpec. Each variant is laid over the spec as it
/// was written, and must give a good spec; its problems point into /variants/i, those of a sweep's at /sweep.
Result<Evaluation> decodeEvaluation(std::string_view json);

/// The report that a server wrote as JSON; what it says beyond our rows is passed over. Nothing = it is no report.
std::optional<EvaluationReport> readEvaluationReport(std::string_view json);

/// The same problems, seen from the document that `place` is in.
Problems within(Problems problems, const std::string& place);

/// Adds a problem for each null of a patch that takes away what no spec has: it leaves nothing behind that the decoder
/// could find fault with.
void checkRemovals(const Json& patch, ProblemList& problems);

/// Adds the rules across fields that the request's spec breaks, but for what its known problems explain.
void checkSpecRules(const FrameSpec& spec, ProblemList& problems);

/// The request's spec as it was written; {} where it is no object.
Json writtenSpec(const Json& request);

/// Adds the problems of a patched spec, which came from `place`, but for those that the request's own spec has among
/// `known`.
void addPatchProblems(const Problems& found, const Problems& known, const std::string& place, ProblemList& problems);

/// A variant of a sweep.
struct SweepVariant {
  std::string name; ///< "pcf 5", "hard 4 x Large"
  Json patch;       ///< over the spec
};

/// The variants of a sweep over a spec in JSON (an object), each once. What they set goes for lights with a shadow of
/// their own as well, and takes away what would contradict it (a filter's radius, manual splits).
std::vector<SweepVariant> sweepVariants(Sweep sweep, const Json& spec);

/// A name for a variant from what it changes: "filter.type hard, cascadeCount 2". A patch of nothing is "as given".
std::string variantName(const Json& patch);

} // namespace gnomon
