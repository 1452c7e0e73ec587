#pragma once

#include "protocol/evaluation/evaluation.h"
#include "protocol/fields/fields.h"
#include "protocol/report/reply_rows.h"
#include "protocol/spec/field_rows.h"

/// The rows of an evaluation, asked for and answered; see field_rows.h.
namespace gnomon {

template <>
inline constexpr std::array kSpellings<Sweep>{
    spelling(Sweep::techniques, "techniques", "hard and filtered shadow maps, hybrid, shadow volumes, rays"),
    spelling(Sweep::filters, "filters", "shadow maps with every filter at every size in texels"),
    spelling(Sweep::sizes, "sizes", "hard shadow maps, XSmall to XLarge, with 1, 2 and 4 cascades"),
    spelling(Sweep::all, "all", "all of these"),
};
static_assert(spellsAll<Sweep>());

template <>
inline constexpr auto kRows<CameraPath> =
    rows("CameraPath", "Where the camera goes so that shimmer shows; exactly one of `cameras` and `step`.",
         field("cameras", &CameraPath::cameras,
               {.says = "One a frame, whatever the variant's own.", .minCount = 2, .maxCount = kLimits.maxPathFrames}),
         field("step", &CameraPath::step,
               {.says = "What each variant's own camera moves by from frame to frame.",
                .unit = "metres",
                .range = kPositionRange}),
         field("frames", &CameraPath::frames,
               {.says = "With `step`: how many; absent = 16.",
                .unit = "frames",
                .range = {2, double(kLimits.maxPathFrames)}}))
        .withAlternatives({"cameras", "step"}, {"cameras", "frames"});
static_assert(kRowsAreComplete<CameraPath>);

template <>
inline constexpr auto kRows<EvaluationRequest> =
    rows("EvaluationRequest", "What to measure on a scene; exactly one of `variants` and `sweep`.",
         field("spec", &EvaluationRequest::spec, {.says = "What every variant begins with; names no `quality`."}),
         field("variants", &EvaluationRequest::variants,
               {.says = "One row each: what it changes in `spec`, as a JSON merge patch (RFC 7396): objects are laid "
                        "over, null takes a field away, lists are replaced.",
                .minCount = 1,
                .maxCount = kLimits.maxVariants}),
         field("sweep", &EvaluationRequest::sweep, {.says = "Variants by name, for all lights that cast."}),
         field("repeats", &EvaluationRequest::repeats,
               {.says = "Timed frames of a variant, of which the median counts.", .unit = "frames", .range = {1, 100}}),
         field("referenceSamples", &EvaluationRequest::referenceSamples,
               {.says = "Rays a pixel of the reference towards a light that has a size; one for others.",
                .unit = "rays",
                .range = {1, double(kLimits.maxRaySamples)}}),
         field("path", &EvaluationRequest::path,
               {.says = "Cameras along which shimmer is measured; absent = it is not."}))
        .withAlternatives({"variants", "sweep"});
static_assert(kRowsAreComplete<EvaluationRequest>);

template <>
inline constexpr auto kRows<VariantProblem> =
    replyRows("VariantProblem", "Why a variant could not be measured.",
              field("code", &VariantProblem::code, {.says = "What kind of thing is wrong."}),
              field("pointer", &VariantProblem::pointer,
                    {.says = "Where: a JSON pointer into the variant's spec; /path = the evaluation's own."}),
              field("detail", &VariantProblem::detail, {.says = "One sentence for people."}),
              field("limit", &VariantProblem::limit, {.says = "What would have been accepted."}),
              field("actual", &VariantProblem::actual, {.says = "What came."}));
static_assert(kRowsAreComplete<VariantProblem>);

template <>
inline constexpr auto kRows<EvaluationRow> = replyRows(
    "EvaluationRow", "One variant: its speed and its error, or why there are none.",
    field("variant", &EvaluationRow::variant, {.says = "What it changes in the spec, as given or as generated."}),
    field("name", &EvaluationRow::name, {.says = "A short name."}),
    field("milliseconds", &EvaluationRow::milliseconds,
          {.says = "Of a whole warm frame, its tiles drawn anew, not encoded: the median. Absent in an event `row`, "
                   "and where there is a problem.",
           .unit = "milliseconds"}),
    field("stages", &EvaluationRow::stages, {.says = "Medians of its stages, each by itself.", .unit = "milliseconds"}),
    field("memoryBytes", &EvaluationRow::memoryBytes,
          {.says = "What the frame takes on the device, its scene included.", .unit = "bytes"}),
    field("metrics", &EvaluationRow::metrics, {.says = "Its error; absent where there is a problem."}),
    field("pareto", &EvaluationRow::pareto,
          {.says = "True = no other row is faster and misclassifies no more. Absent in an event `row`."}),
    field("problems", &EvaluationRow::problems, {.says = "Why it could not be measured; else absent."}));
static_assert(kRowsAreComplete<EvaluationRow>);

template <>
inline constexpr auto kRows<ReferenceReport> = replyRows(
    "ReferenceReport", "The rays that the rows were held against.",
    field("milliseconds", &ReferenceReport::milliseconds, {.says = "Of tracing.", .unit = "milliseconds"}),
    field("buildMilliseconds", &ReferenceReport::buildMilliseconds,
          {.says = "Of sorting the scene for rays, before.", .unit = "milliseconds"}),
    field("samples", &ReferenceReport::samples, {.says = "Rays a pixel towards lights that have a size."}),
    field("frames", &ReferenceReport::frames, {.says = "Traced ones; variants that show the same share one."}));
static_assert(kRowsAreComplete<ReferenceReport>);

template <>
inline constexpr auto kRows<EvaluationReport> = replyRows(
    "EvaluationReport", "Speed against error.",
    field("rows", &EvaluationReport::rows, {.says = "One a variant, in their order."}),
    field("reference", &EvaluationReport::reference, {.says = "The rays that they were held against."}),
    field("renderer", &EvaluationReport::renderer, {.says = "What drew the frames: times are those of this machine."}));
static_assert(kRowsAreComplete<EvaluationReport>);

template <>
inline constexpr auto kRows<EvaluationStep> =
    replyRows("EvaluationStep", "How far an evaluation has come: the data of an event `progress`.",
              field("done", &EvaluationStep::done, {.says = "Frames, references and paths that are finished."}),
              field("of", &EvaluationStep::of, {.says = "Of all; fewer come where a variant has a problem."}),
              field("variant", &EvaluationStep::variant, {.says = "Index of the one that is worked on."}));
static_assert(kRowsAreComplete<EvaluationStep>);

} // namespace gnomon
