#pragma once

#include "protocol/evaluation/evaluation_rows.h"
#include "protocol/report/reply_rows.h"
#include "protocol/report/report_rows.h"
#include "protocol/sequence/sequence.h"

/// The rows of a sequence, asked for and answered; see fields.h.
namespace gnomon {

template <>
inline constexpr auto kRows<CarriedRange> = rows(
    "CarriedRange", "The view depths that one light's cascades cover.",
    field<&CarriedRange::light>("Index into the lights of the frame.", {.range = {0, double(kLimits.maxLights - 1)}}),
    field<&CarriedRange::near>("View depth where the range begins.", {.unit = "metres", .range = kPositionRange}),
    field<&CarriedRange::far>("View depth where the range ends, more than `near`.",
                              {.unit = "metres", .range = kPositionRange}));

template <>
inline constexpr auto kRows<Carried> =
    rows("Carried", "What a frame of a sequence takes from the one before it. Pass it on unchanged.",
         field<&Carried::depthRanges>("For each light with cascades the depths that they cover.",
                                      {.maxCount = std::size_t(kLimits.maxLights)}));

template <>
inline constexpr auto kRows<SequenceRequest> =
    rows("SequenceRequest", "Many frames of one scene; exactly one of `frames` and `keys`.",
         field<&SequenceRequest::spec>("What every frame starts from; must not have `quality`."),
         field<&SequenceRequest::frames>("One frame for each: what it changes in `spec`, as a JSON merge patch (RFC "
                                         "7396): objects are merged, null removes a field, lists are replaced.",
                                         {.minCount = 1, .maxCount = kLimits.maxSequenceFrames}),
         field<&SequenceRequest::keys>(
             "Patches as in `frames`, between which `count` frames lie at equal steps: the first frame is the first "
             "key, the last frame the last key. In between, numbers and times (of a sun) at the same place of two "
             "neighbouring keys are interpolated linearly; whole numbers and all else must be equal.",
             {.minCount = 2, .maxCount = kLimits.maxSequenceKeys}),
         field<&SequenceRequest::count>("With `keys`: number of frames.",
                                        {.unit = "frames", .range = {2, double(kLimits.maxSequenceFrames)}}),
         field<&SequenceRequest::stable>(
             "Shadows of directional lights hold still while the camera moves, and depth ranges pass from frame to "
             "frame, except where the spec has `stabilization` or `depthRange` itself. False = each frame is drawn as "
             "if it were alone, with the tightest fit."),
         field<&SequenceRequest::framesPerSecond>("Frame rate of a video. Every other form repeats it in its report, "
                                                  "for making a video of the frames; it changes no frame.",
                                                  {.unit = "frames per second", .range = {1, 240}}),
         field<&SequenceRequest::videoQuality>(
             "Of a video (`Accept: video/webm`): 1 = smallest file, 100 = closest to the frames. Each frame is as good "
             "as every other, whatever size that takes: 50 is less than half as large as the default, 90 two thirds "
             "larger, 100 three times as large.",
             {.range = {1, 100}}),
         field<&SequenceRequest::first>(
             "Index of the first frame that is drawn: 0, or where a sequence that broke off goes on.",
             {.range = {0, double(kLimits.maxSequenceFrames - 1)}}),
         field<&SequenceRequest::carried>("What the frame before `first` left, from its reply. Needed with `first` if "
                                          "the sequence is stable; with `first` 0 it continues another sequence."))
        .withAlternatives({"frames", "keys"}, {"frames", "count"});

template <>
inline constexpr auto kRows<SequenceFrame> = replyRows(
    "SequenceFrame", "One frame of a sequence: the data of an event `frame`.",
    field<&SequenceFrame::index>("Which frame."), field<&SequenceFrame::of>("Number of frames of the sequence."),
    field<&SequenceFrame::images>("Its pictures, as in a FrameReply."),
    field<&SequenceFrame::carried>("What the next frame needs, if the sequence goes on there."),
    field<&SequenceFrame::stages>("Time of each stage.", {.unit = "milliseconds"}));

template <>
inline constexpr auto kRows<SequenceFrameReport> = replyRows(
    "SequenceFrameReport", "Times of one frame of a sequence.", field<&SequenceFrameReport::index>("Which frame."),
    field<&SequenceFrameReport::milliseconds>("Time from its beginning to its pictures; neighbouring frames overlap.",
                                              {.unit = "milliseconds"}),
    field<&SequenceFrameReport::stages>("Time of each stage.", {.unit = "milliseconds"}));

template <>
inline constexpr auto kRows<SequenceReport> = replyRows(
    "SequenceReport", "Times of a sequence, and what continues it.",
    field<&SequenceReport::frames>("One entry for each frame that was drawn."),
    field<&SequenceReport::milliseconds>(
        "Time from the first frame's beginning to the last one's pictures, waiting for the client included.",
        {.unit = "milliseconds"}),
    field<&SequenceReport::framesPerSecond>("As requested.", {.unit = "frames per second"}),
    field<&SequenceReport::carried>("What the last frame leaves to a sequence that continues this one."),
    field<&SequenceReport::warnings>("What differs from the request, over all frames, each once; at most 32."),
    field<&SequenceReport::renderer>("The graphics context that drew the frames."));

} // namespace gnomon
