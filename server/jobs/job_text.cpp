#include "server/jobs/job_text.h"

#include <nlohmann/json.hpp>

#include "protocol/fields/field_decode.h"
#include "protocol/fields/field_encode.h"
#include "protocol/fields/type_tables.h"
#include "protocol/json/json_codec.h"
#include "protocol/json/problem_rows.h"
#include "protocol/sequence/sequence_json.h"
#include "server/wire/sequence_news.h"

namespace gnomon {

template <>
inline constexpr auto kRows<FrameNote> =
    rows("FrameNote", "All about a drawn frame but its pictures.",
         field("contentKey", &FrameNote::contentKey, {.says = "What the pictures depend on."}),
         field("carried", &FrameNote::carried, {.says = "Of this frame alone."}),
         field("warnings", &FrameNote::warnings, {.says = "Of its report."}),
         field("stages", &FrameNote::stages, {.says = "Time of each stage.", .unit = "milliseconds"}),
         field("milliseconds", &FrameNote::milliseconds, {.says = "Time of all.", .unit = "milliseconds"}),
         field("pictures", &FrameNote::pictures, {.says = "In the order of their bytes."}));
static_assert(kRowsAreComplete<FrameNote>);

namespace {

struct ProblemsText {
  std::vector<Problem> problems{};
};

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
                                                 field("problems", &ProblemsText::problems, {.says = "All of them."}));
static_assert(kRowsAreComplete<ProblemsText>);

template const ValueType& typeOf<FrameNote>();
template const ValueType& typeOf<ProblemsText>();

std::string textOf(const FrameNote& note) {
  return jsonText(encodeValue(note));
}
std::string textOf(const Problems& problems) {
  return jsonText(encodeValue(ProblemsText{problems}));
}
std::string textOf(const Carried& carried) {
  return jsonText(toJson(carried));
}

std::optional<FrameNote> readFrameNote(std::string_view text) {
  return readValue<FrameNote>(text);
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
