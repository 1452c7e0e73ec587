#include "server/wire/messages.h"

#include <nlohmann/json.hpp>

#include "protocol/fields/field_codec.h"
#include "protocol/fields/type_tables.h"
#include "protocol/json/json_codec.h"
#include "server/wire/message_rows.h"

namespace gnomon {

template const ValueType& typeOf<ToFront>();
template const ValueType& typeOf<ToWorker>();

namespace {

/// The message, where its text is that of exactly one of its kinds.
template <class Message>
std::optional<Message> readMessage(std::string_view text) {
  ProblemList problems;
  Message message;
  const std::optional<JsonNode> root = readJson(text, problems);
  if (!root || !decodeValue(*root, Notes{}, Place(), problems, message) || !problems.empty()) return std::nullopt;
  int kinds = 0;
  forEachField<Message>([&](const auto& row) { kinds += (message.*row.member).has_value() ? 1 : 0; });
  if (kinds != 1) return std::nullopt;
  return message;
}

} // namespace

std::string textOf(const ToWorker& message) {
  return jsonText(toJson(message));
}
std::string textOf(const ToFront& message) {
  return jsonText(toJson(message));
}

std::optional<ToWorker> readToWorker(std::string_view text) {
  return readMessage<ToWorker>(text);
}
std::optional<ToFront> readToFront(std::string_view text) {
  return readMessage<ToFront>(text);
}

} // namespace gnomon
