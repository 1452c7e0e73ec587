#include "server/jobs/job_text.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "protocol/fields/field_codec.h"
#include "protocol/fields/type_tables.h"
#include "protocol/json/json_codec.h"
#include "protocol/json/problem_rows.h"
#include "protocol/sequence/sequence.h"
#include "server/wire/messages.h"
#include "server/wire/sequence_news.h"

namespace gnomon {

template <>
inline constexpr auto kRows<FrameNote> = rows("FrameNote", "All about a drawn frame but its pictures.",
                                              field<&FrameNote::contentKey>("What the pictures depend on."),
                                              field<&FrameNote::carried>("Of this frame alone."),
                                              field<&FrameNote::warnings>("Of its report."),
                                              field<&FrameNote::stages>("Time of each stage.",
                                                                        {.unit = "milliseconds"}),
                                              field<&FrameNote::milliseconds>("Time of all.", {.unit = "milliseconds"}),
                                              field<&FrameNote::pictures>("In the order of their bytes."));

namespace {

struct ProblemsText {
  std::vector<Problem> problems{};
};

/// It becomes an entity tag.
bool isContentKey(std::string_view key) {
  return key.size() == 64 && key.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

template <class Value>
std::optional<Value> readValue(std::string_view text) {
  ProblemList problems;
  Value value;
  const std::optional<JsonNode> root = readJson(text, problems);
  if (!root || !decodeValue(*root, Notes{}, Place(), problems, value) || !problems.empty()) return std::nullopt;
  return value;
}

} // namespace

template <>
inline constexpr auto kRows<ProblemsText> = rows("ProblemsText", "Problems.",
                                                 field<&ProblemsText::problems>("All of them."));

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
