#pragma once

#include "protocol/evaluation/evaluation.h"
#include "protocol/fields/value_type.h"
#include "protocol/report/reply_rows.h"
#include "protocol/spec/field_rows.h"

/// The rows of an evaluation, asked for and answered; see field_rows.h.
namespace gnomon {

/// A patch keeps the JSON that it is. Defined in evaluation.cpp.
bool decodePatch(const JsonNode& node, const Place& place, ProblemList& problems, void* out);
Json encodePatch(const void* patch);
Json patchSchema();

template <>
inline constexpr CustomType kCustomType<SpecPatch>{decodePatch, encodePatch, patchSchema};

template <>
inline constexpr std::array kSpellings<Sweep>{
    spelling<Sweep::techniques>("hard and filtered shadow maps, shadow volumes, rays"),
    spelling<Sweep::filters>("shadow maps with every filter at every size in texels"),
    spelling<Sweep::sizes>("hard shadow maps, XSmall to XLarge, with 1, 2 and 4 cascades"),
    spelling<Sweep::all>("all of these"),
};

template <>
inline constexpr std::array kSpellings<RankedError>{
    spelling<RankedError::misclassified>("the share of misclassified receivers"),
    spelling<RankedError::rms>("the root mean square of the difference, where the environment's share is measured"),
};

template <>
inline constexpr auto kRows<CameraPath> =
    rows("CameraPath", "A path of cameras for measuring shimmer; exactly one of `cameras` and `step`.",
         field<&CameraPath::cameras>("One camera for each frame, used for every variant instead of its own.",
                                     {.minCount = 2, .maxCount = kLimits.maxPathFrames}),
         field<&CameraPath::step>("How far each variant's own camera moves from frame to frame.",
                                  {.unit = "metres", .range = kPositionRange}),
         field<&CameraPath::frames>(
             "With `step`: number of frames; absent = 16. More make the figure steadier and take longer.",
             {.unit = "frames", .range = {2, double(kLimits.maxPathFrames)}}))
        .withAlternatives({"cameras", "step"}, {"cameras", "frames"});

template <>
inline constexpr auto kRows<EvaluationRequest> =
    rows("EvaluationRequest", "What to measure on a scene; exactly one of `variants` and `sweep`.",
         field<&EvaluationRequest::spec>("What every variant starts from; must not have `quality`."),
         field<&EvaluationRequest::variants>("One row for each: what it changes in `spec`, as a JSON merge patch (RFC "
                                             "7396): objects are merged, null removes a field, lists are replaced.",
                                             {.minCount = 1, .maxCount = kLimits.maxVariants}),
         field<&EvaluationRequest::sweep>("A named set of variants, applied to all lights that cast shadows."),
         field<&EvaluationRequest::repeats>(
             "Timed frames of each variant; their median counts. More make times steadier and take longer.",
             {.unit = "frames", .range = {1, 100}}),
         field<&EvaluationRequest::referenceSamples>(
             "Rays for each pixel of the reference towards a light that has a size; other lights take one. More make "
             "the reference less noisy and slower to trace.",
             {.unit = "rays", .range = {1, double(kLimits.maxRaySamples)}}),
         field<&EvaluationRequest::path>("Cameras along which shimmer is measured; absent = it is not measured."))
        .withAlternatives({"variants", "sweep"});

template <>
inline constexpr auto kRows<VariantProblem> = replyRows(
    "VariantProblem", "Why a variant could not be measured.", field<&VariantProblem::code>("Kind of problem."),
    field<&VariantProblem::pointer>(
        "Where: a JSON pointer into the variant's spec; /path = the evaluation's own path."),
    field<&VariantProblem::detail>("A sentence for people."),
    field<&VariantProblem::limit>("What would have been accepted."), field<&VariantProblem::actual>("What was sent."));

template <>
inline constexpr auto kRows<EvaluationRow> = replyRows(
    "EvaluationRow", "One variant: its speed and its error, or why there are none.",
    field<&EvaluationRow::variant>("What it changes in the spec, as given or as generated."),
    field<&EvaluationRow::name>("Short name."),
    field<&EvaluationRow::milliseconds>("Median time of a whole warm frame, with all tiles drawn again, without "
                                        "encoding. Absent in an event `row`, and if there is a problem.",
                                        {.unit = "milliseconds"}),
    field<&EvaluationRow::stages>("Median time of each stage.", {.unit = "milliseconds"}),
    field<&EvaluationRow::memoryBytes>("Memory that the frame takes on the device, its scene included.",
                                       {.unit = "bytes"}),
    field<&EvaluationRow::metrics>("Its error; absent if there is a problem."),
    field<&EvaluationRow::pareto>("True = no other row is faster and has no more of the error that rows are "
                                  "`rankedBy`. Absent in an event `row`."),
    field<&EvaluationRow::problems>("Why it could not be measured; absent if it was."));

template <>
inline constexpr auto kRows<ReferenceReport> =
    replyRows("ReferenceReport", "The exact shadows that the rows were compared with.",
              field<&ReferenceReport::milliseconds>("Time of tracing.", {.unit = "milliseconds"}),
              field<&ReferenceReport::buildMilliseconds>("Time of building the ray tracing structure, before tracing.",
                                                         {.unit = "milliseconds"}),
              field<&ReferenceReport::samples>(
                  "Rays for each pixel towards lights that have a size, and towards an environment."),
              field<&ReferenceReport::frames>("Number of traced references; variants that see the same share one."));

template <>
inline constexpr auto kRows<EvaluationReport> = replyRows(
    "EvaluationReport", "Speed against error.", field<&EvaluationReport::rows>("One for each variant, in their order."),
    field<&EvaluationReport::rankedBy>("The metric that is a row's error."),
    field<&EvaluationReport::reference>("The exact shadows that the rows were compared with."),
    field<&EvaluationReport::renderer>("The graphics context that drew the frames: times are those of this machine."));

template <>
inline constexpr auto kRows<EvaluationStep> =
    replyRows("EvaluationStep", "Progress of an evaluation: the data of an event `progress`.",
              field<&EvaluationStep::done>("Frames, references and paths finished."),
              field<&EvaluationStep::of>("Number of all; fewer are done if a variant has a problem."),
              field<&EvaluationStep::variant>("Index of the variant in progress."));

} // namespace gnomon
