#include "server/jobs/job_text.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "protocol/fields/type_tables.h"
#include "protocol/json/json_codec.h"
#include "protocol/json/problem_rows.h"
#include "protocol/sequence/sequence.h"
#include "server/wire/messages.h"
#include "server/wire/read_value.h"
#include "server/wire/sequence_news.h"

namespace gnomon {

template <>
inline constexpr auto kRows<FrameNote> =
    plainRows<&FrameNote::contentKey, &FrameNote::carried, &FrameNote::warnings, &FrameNote::stages,
              &FrameNote::milliseconds, &FrameNote::pictures>("FrameNote");

namespace {

struct ProblemsText {
  std::vector<Problem> problems{};
};

/// It becomes an entity tag.
bool isContentKey(std::string_view key) {
  return key.size() == 64 && key.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

} // namespace

template <>
inline constexpr auto kRows<ProblemsText> = plainRows<&ProblemsText::problems>("ProblemsText");

template const ValueType& typeOf<FrameNote>();
template const ValueType& typeOf<ProblemsText>();

std::string textOf(const FrameNote& note) {
  return jsonText(toJson(note));
}
std::string textOf(const Problems& problems) {
  return jsonText(toJson(ProblemsText{problems}));
}
std::string textOf(const Carried& carried) {
  return jsonText(toJson(carried));
}

std::optional<FrameNote> readFrameNote(std::string_view text) {
  auto note = readValue<FrameNote>(text);
  const bool isSound = note && isContentKey(note->contentKey) && areStages(note->stages) && note->milliseconds >= 0 &&
                       note->milliseconds <= kMostMilliseconds && bytesOf(note->pictures);
  return isSound ? std::move(note) : std::nullopt;
}

std::optional<Problems> readProblems(std::string_view text) {
  auto read = readValue<ProblemsText>(text);
  if (!read) return std::nullopt;
  return std::move(read->problems);
}

std::optional<Carried> readCarried(std::string_view text) {
  auto read = decodeCarried(text);
  if (!read) return std::nullopt;
  return *std::move(read);
}

} // namespace gnomon
