#include "server/wire/sequence_news.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "protocol/fields/type_tables.h"
#include "server/wire/frame_pictures.h"
#include "server/wire/read_value.h"

namespace gnomon {

template const ValueType& typeOf<SequenceNews>();

std::string textOf(const SequenceNews& news) {
  return jsonText(toJson(news));
}

std::optional<SequenceNews> readSequenceNews(std::string_view text) {
  auto news = readValue<SequenceNews>(text);
  const auto isSound = [&] {
    return news->pictures.empty() ? news->drawn.has_value() : bytesOf(news->pictures).has_value();
  };
  return news && isSound() ? std::move(news) : std::nullopt;
}

} // namespace gnomon
