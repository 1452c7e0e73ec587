#pragma once

#include <optional>
#include <string_view>

#include "protocol/fields/field_codec.h"
#include "protocol/json/json_codec.h"

namespace gnomon {

/// The struct whose rows a text follows as JSON; nothing where it does not.
template <Described Value>
std::optional<Value> readValue(std::string_view text) {
  ProblemList problems;
  Value value;
  const std::optional<JsonNode> root = readJson(text, problems);
  if (!root || !decodeValue(*root, Notes{}, Place(), problems, value) || !problems.empty()) return std::nullopt;
  return value;
}

} // namespace gnomon
