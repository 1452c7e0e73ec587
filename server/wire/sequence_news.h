#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/sequence/sequence.h"
#include "protocol/sequence/sequence_rows.h"

/// What an order of kind sequenceFrame sends as its event kSequenceNews: first that the frame is drawn, so that the
/// next one can begin, and then, once it is encoded, what its bytes are.
namespace gnomon {

inline constexpr std::string_view kSequenceNews = "news";

/// The media type of such an order whose result is the first view alone, as encodeI420 (renderer/image) gives it.
inline constexpr std::string_view kRawVideo = "video/raw";

struct DrawnNews {
  Carried carried{}; ///< of this frame alone
  std::vector<std::string> warnings{};
};

/// A picture among the bytes of the result.
struct PictureNews {
  std::string view{};
  std::string contentType{};
  std::uint64_t bytes = 0;
  int width = 0;  ///< pixels, of a raw picture; else 0
  int height = 0; ///< pixels
};

struct SequenceNews {
  std::optional<DrawnNews> drawn{};
  std::vector<PictureNews> pictures{}; ///< in the order of their bytes; empty while it is not encoded
};

std::string textOf(const SequenceNews& news);

/// Nothing where the text is no such news.
std::optional<SequenceNews> readSequenceNews(std::string_view text);

// The rows of these; see fields.h.
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
