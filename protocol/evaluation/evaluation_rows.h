#pragma once

#include "protocol/evaluation/evaluation.h"
#include "protocol/fields/value_type.h"
#include "protocol/report/reply_rows.h"
#include "protocol/spec/field_rows.h"

/// The rows of an evaluation, asked for and answered; see field_rows.h.
namespace gnomon {

/// A patch keeps the JSON that it is. Defined in evaluation_json.cpp.
bool decodePatch(const JsonNode& node, const Place& place, ProblemList& problems, void* out);
Json encodePatch(const void* patch);
Json patchSchema();

template <>
inline constexpr CustomType kCustomType<SpecPatch>{decodePatch, encodePatch, patchSchema};

template <>
inline constexpr std::array kSpellings<Sweep>{
    spelling(Sweep::techniques, "techniques", "hard and filtered shadow maps, shadow volumes, rays"),
    spelling(Sweep::filters, "filters", "shadow maps with every filter at every size in texels"),
    spelling(Sweep::sizes, "sizes", "hard shadow maps, XSmall to XLarge, with 1, 2 and 4 cascades"),
    spelling(Sweep::all, "all", "all of these"),
};
static_assert(spellsAll<Sweep>());

template <>
inline constexpr auto kRows<CameraPath> =
    rows("CameraPath", "A path of cameras for measuring shimmer; exactly one of `cameras` and `step`.",
         field("cameras", &CameraPath::cameras,
               {.says = "One camera for each frame, used for every variant instead of its own.",
                .minCount = 2,
                .maxCount = kLimits.maxPathFrames}),
         field("step", &CameraPath::step,
               {.says = "How far each variant's own camera moves from frame to frame.",
                .unit = "metres",
                .range = kPositionRange}),
         field("frames", &CameraPath::frames,
               {.says = "With `step`: number of frames; absent = 16. More make the figure steadier and take longer.",
                .unit = "frames",
                .range = {2, double(kLimits.maxPathFrames)}}))
        .withAlternatives({"cameras", "step"}, {"cameras", "frames"});
static_assert(kRowsAreComplete<CameraPath>);

template <>
inline constexpr auto kRows<EvaluationRequest> =
    rows("EvaluationRequest", "What to measure on a scene; exactly one of `variants` and `sweep`.",
         field("spec", &EvaluationRequest::spec, {.says = "What every variant starts from; must not have `quality`."}),
         field("variants", &EvaluationRequest::variants,
               {.says = "One row for each: what it changes in `spec`, as a JSON merge patch (RFC 7396): objects are "
                        "merged, null removes a field, lists are replaced.",
                .minCount = 1,
                .maxCount = kLimits.maxVariants}),
         field("sweep", &EvaluationRequest::sweep,
               {.says = "A named set of variants, applied to all lights that cast shadows."}),
         field("repeats", &EvaluationRequest::repeats,
               {.says = "Timed frames of each variant; their median counts. More make times steadier and take longer.",
                .unit = "frames",
                .range = {1, 100}}),
         field("referenceSamples", &EvaluationRequest::referenceSamples,
               {.says = "Rays for each pixel of the reference towards a light that has a size; other lights take one. "
                        "More make the reference less noisy and slower to trace.",
                .unit = "rays",
                .range = {1, double(kLimits.maxRaySamples)}}),
         field("path", &EvaluationRequest::path,
               {.says = "Cameras along which shimmer is measured; absent = it is not measured."}))
        .withAlternatives({"variants", "sweep"});
static_assert(kRowsAreComplete<EvaluationRequest>);

template <>
inline constexpr auto kRows<VariantProblem> =
    replyRows("VariantProblem", "Why a variant could not be measured.",
              field("code", &VariantProblem::code, {.says = "Kind of problem."}),
              field("pointer", &VariantProblem::pointer,
                    {.says = "Where: a JSON pointer into the variant's spec; /path = the evaluation's own path."}),
              field("detail", &VariantProblem::detail, {.says = "A sentence for people."}),
              field("limit", &VariantProblem::limit, {.says = "What would have been accepted."}),
              field("actual", &VariantProblem::actual, {.says = "What was sent."}));
static_assert(kRowsAreComplete<VariantProblem>);

template <>
inline constexpr auto kRows<EvaluationRow> = replyRows(
    "EvaluationRow", "One variant: its speed and its error, or why there are none.",
    field("variant", &EvaluationRow::variant, {.says = "What it changes in the spec, as given or as generated."}),
    field("name", &EvaluationRow::name, {.says = "Short name."}),
    field(
        "milliseconds", &EvaluationRow::milliseconds,
        {.says = "Median time of a whole warm frame, with all tiles drawn again, without encoding. Absent in an event "
                 "`row`, and if there is a problem.",
         .unit = "milliseconds"}),
    field("stages", &EvaluationRow::stages, {.says = "Median time of each stage.", .unit = "milliseconds"}),
    field("memoryBytes", &EvaluationRow::memoryBytes,
          {.says = "Memory that the frame takes on the device, its scene included.", .unit = "bytes"}),
    field("metrics", &EvaluationRow::metrics, {.says = "Its error; absent if there is a problem."}),
    field("pareto", &EvaluationRow::pareto,
          {.says = "True = no other row is faster and misclassifies no more receivers. Absent in an event `row`."}),
    field("problems", &EvaluationRow::problems, {.says = "Why it could not be measured; absent if it was."}));
static_assert(kRowsAreComplete<EvaluationRow>);

template <>
inline constexpr auto kRows<ReferenceReport> = replyRows(
    "ReferenceReport", "The exact shadows that the rows were compared with.",
    field("milliseconds", &ReferenceReport::milliseconds, {.says = "Time of tracing.", .unit = "milliseconds"}),
    field("buildMilliseconds", &ReferenceReport::buildMilliseconds,
          {.says = "Time of building the ray tracing structure, before tracing.", .unit = "milliseconds"}),
    field("samples", &ReferenceReport::samples, {.says = "Rays for each pixel towards lights that have a size."}),
    field("frames", &ReferenceReport::frames,
          {.says = "Number of traced references; variants that see the same share one."}));
static_assert(kRowsAreComplete<ReferenceReport>);

template <>
inline constexpr auto kRows<EvaluationReport> = replyRows(
    "EvaluationReport", "Speed against error.",
    field("rows", &EvaluationReport::rows, {.says = "One for each variant, in their order."}),
    field("reference", &EvaluationReport::reference, {.says = "The exact shadows that the rows were compared with."}),
    field("renderer", &EvaluationReport::renderer,
          {.says = "The graphics context that drew the frames: times are those of this machine."}));
static_assert(kRowsAreComplete<EvaluationReport>);

template <>
inline constexpr auto kRows<EvaluationStep> =
    replyRows("EvaluationStep", "Progress of an evaluation: the data of an event `progress`.",
              field("done", &EvaluationStep::done, {.says = "Frames, references and paths finished."}),
              field("of", &EvaluationStep::of, {.says = "Number of all; fewer are done if a variant has a problem."}),
              field("variant", &EvaluationStep::variant, {.says = "Index of the variant in progress."}));
static_assert(kRowsAreComplete<EvaluationStep>);

} // namespace gnomon
