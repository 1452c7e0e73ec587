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

/// Nothing where the text is no such news, or its pictures can't be a frame's (frame_pictures.h).
std::optional<SequenceNews> readSequenceNews(std::string_view text);

// The rows of these; see fields.h.
template <>
inline constexpr auto kRows<DrawnNews> = plainRows<&DrawnNews::carried, &DrawnNews::warnings>("DrawnNews");

template <>
inline constexpr auto kRows<PictureNews> = plainRows<&PictureNews::view, &PictureNews::contentType, &PictureNews::bytes,
                                                     &PictureNews::width, &PictureNews::height>("PictureNews");

template <>
inline constexpr auto kRows<SequenceNews> = plainRows<&SequenceNews::drawn, &SequenceNews::pictures>("SequenceNews");

} // namespace gnomon
