#include "server/wire/sequence_news.h"

#include <nlohmann/json.hpp>

#include "protocol/fields/field_codec.h"
#include "protocol/fields/type_tables.h"
#include "protocol/json/json_codec.h"

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
  return news;
}

} // namespace gnomon
