#include "server/wire/sequence_news.h"

#include <nlohmann/json.hpp>

#include "protocol/fields/field_decode.h"
#include "protocol/fields/field_encode.h"
#include "protocol/fields/type_tables.h"
#include "protocol/json/json_codec.h"
#include "protocol/sequence/sequence_rows.h"

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
    field("bytes", &PictureNews::bytes, {.says = "Its size.", .unit = "bytes"}));
static_assert(kRowsAreComplete<PictureNews>);

template <>
inline constexpr auto kRows<SequenceNews> = rows("SequenceNews", "How far a frame of a sequence is.",
                                                 field("drawn", &SequenceNews::drawn, {.says = "It is drawn."}),
                                                 field("pictures", &SequenceNews::pictures, {.says = "Its pictures."}));
static_assert(kRowsAreComplete<SequenceNews>);

template const ValueType& typeOf<SequenceNews>();

std::string textOf(const SequenceNews& news) {
  return jsonText(encodeValue(news));
}

std::optional<SequenceNews> readSequenceNews(std::string_view text) {
  ProblemList problems;
  SequenceNews news;
  const std::optional<JsonNode> root = readJson(text, problems);
  if (!root || !decodeValue(*root, Notes{}, Place(), problems, news) || !problems.empty()) return std::nullopt;
  return news;
}

} // namespace gnomon
