#include "protocol/evaluation/evaluation_codec.h"

namespace gnomon {

Json jsonOf(const JsonNode& node) {
  struct Converted {
    Json operator()(std::nullptr_t) const { return nullptr; }
    Json operator()(bool value) const { return value; }
    Json operator()(std::int64_t value) const { return value; }
    Json operator()(std::uint64_t value) const { return value; }
    Json operator()(const JsonReal& real) const { return real.value; }
    Json operator()(const std::string& text) const { return text; }
    Json operator()(const JsonNode::Array& array) const {
      Json json = Json::array();
      for (const JsonNode& element : array) json.push_back(jsonOf(element));
      return json;
    }
    Json operator()(const JsonNode::Object& object) const {
      Json json = Json::object();
      for (const JsonMember& member : object) json[member.key] = jsonOf(member.value);
      return json;
    }
  };
  return std::visit(Converted{}, node.value);
}

JsonNode nodeOf(const Json& json) {
  if (json.is_boolean()) return {json.get<bool>()};
  if (json.is_number_unsigned()) return {json.get<std::uint64_t>()};
  if (json.is_number_integer()) return {json.get<std::int64_t>()};
  if (json.is_number()) return {JsonReal{json.get<double>(), json.dump()}};
  if (json.is_string()) return {json.get<std::string>()};
  if (json.is_array()) {
    JsonNode::Array array;
    for (const Json& element : json) array.push_back(nodeOf(element));
    return {std::move(array)};
  }
  if (!json.is_object()) return {nullptr};
  JsonNode::Object object;
  for (const auto& [key, value] : json.items()) object.push_back({key, nodeOf(value)});
  return {std::move(object)};
}

bool decodeValue(const JsonNode& node, const Notes&, const Place& place, ProblemList& problems, SpecPatch& out) {
  if (!std::holds_alternative<JsonNode::Object>(node.value)) {
    addWrongType(node, "an object", place, problems);
    return false;
  }
  out.json = jsonOf(node).dump();
  return true;
}

Json encodeValue(const SpecPatch& patch) {
  return Json::parse(patch.json);
}

bool decodeValue(const JsonNode& node, const Notes&, const Place& place, ProblemList& problems, std::uint64_t& out) {
  const auto* value = std::get_if<std::uint64_t>(&node.value);
  if (!value) {
    addWrongType(node, "a whole number of at least 0", place, problems);
    return false;
  }
  out = *value;
  return true;
}

bool decodeValue(const JsonNode& node, const Notes& notes, const Place& place, ProblemList& problems,
                 std::vector<StageTime>& out) {
  const auto* object = std::get_if<JsonNode::Object>(&node.value);
  if (!object) {
    addWrongType(node, "an object", place, problems);
    return false;
  }
  for (const JsonMember& member : *object) {
    StageTime stage{member.key};
    if (decodeValue(member.value, notes, Place(place, member.key), problems, stage.milliseconds)) out.push_back(stage);
  }
  return true;
}

} // namespace gnomon
