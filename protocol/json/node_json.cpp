#include "protocol/json/node_json.h"

#include <nlohmann/json.hpp>

#include "protocol/fields/field_decode.h"
#include "protocol/fields/field_encode.h"

namespace gnomon {

Json toJson(const NodeList& list) {
  return encodeValue(list);
}
Json toJson(const NodePage& page) {
  return encodeValue(page);
}

std::optional<NodePage> readNodePage(std::string_view json) {
  ProblemList problems;
  NodePage page;
  const std::optional<JsonNode> root = readJson(json, problems);
  if (!root || !decodeValue(*root, Notes{}, Place(), problems, page) || !problems.empty()) return std::nullopt;
  return page;
}

} // namespace gnomon
