#pragma once

#include "protocol/sequence/sequence_rows.h"
#include "server/wire/sequence_news.h"

/// The rows of reports about a sequence's frames; see fields.h.
namespace gnomon {

template <>
inline constexpr auto kRows<DrawnNews> = rows("DrawnNews", "A frame is drawn.",
                                              field("carried", &DrawnNews::carried, {.says = "Of this frame alone."}),
                                              field("warnings", &DrawnNews::warnings, {.says = "Of its report."}));
static_assert(kRowsAreComplete<DrawnNews>);

template <>
inline constexpr auto kRows<PictureNews> = rows(
    "PictureNews", "A picture among the bytes of the result.", field("view", &PictureNews::view, {.says = "Its view."}),
    field("contentType", &PictureNews::contentType, {.says = "Its media type."}),
    field("bytes", &PictureNews::bytes, {.says = "Its size.", .unit = "bytes"}),
    field("width", &PictureNews::width, {.says = "Of a raw picture.", .unit = "pixels"}),
    field("height", &PictureNews::height, {.says = "Of a raw picture.", .unit = "pixels"}));
static_assert(kRowsAreComplete<PictureNews>);

template <>
inline constexpr auto kRows<SequenceNews> = rows("SequenceNews", "How far a frame of a sequence is.",
                                                 field("drawn", &SequenceNews::drawn, {.says = "It is drawn."}),
                                                 field("pictures", &SequenceNews::pictures, {.says = "Its pictures."}));
static_assert(kRowsAreComplete<SequenceNews>);

} // namespace gnomon
