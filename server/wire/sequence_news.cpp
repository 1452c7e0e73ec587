#include "server/wire/sequence_news.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "protocol/fields/field_codec.h"
#include "protocol/fields/type_tables.h"
#include "protocol/json/json_codec.h"
#include "server/wire/frame_pictures.h"

namespace gnomon {

template const ValueType& typeOf<SequenceNews>();

std::string textOf(const SequenceNews& news) {
  return jsonText(toJson(news));
}

std::optional<SequenceNews> readSequenceNews(std::string_view text) {
  ProblemList problems;
  SequenceNews news;
  const std::optional<JsonNode> root = readJson(text, problems);
  if (!root || !decodeValue(*root, Notes{}, Place(), problems, news) || !problems.empty()) return std::nullopt;
  const bool isSound = news.pictures.empty() ? news.drawn.has_value() : bytesOf(news.pictures).has_value();
  return isSound ? std::optional(std::move(news)) : std::nullopt;
}

} // namespace gnomon
