#include "protocol/json/json_codec.h"

#include <nlohmann/json.hpp>

#include "protocol/fields/field_decode.h"
#include "protocol/fields/field_encode.h"
#include "protocol/report/frame_report.h"
#include "protocol/spec/validate.h"

namespace gnomon {

bool decodeStages(const JsonNode& node, const Place& place, ProblemList& problems, void* out) {
  const auto* object = std::get_if<JsonNode::Object>(&node.value);
  if (!object) {
    addWrongType(node, "an object", place, problems);
    return false;
  }
  auto& stages = valueAs<std::vector<StageTime>>(out);
  for (const JsonMember& member : *object) {
    StageTime stage{member.key};
    if (decodeValue(member.value, Notes{}, Place(place, member.key), problems, stage.milliseconds)) {
      stages.push_back(stage);
    }
  }
  return true;
}

Json encodeStages(const void* stages) {
  Json object = Json::object();
  for (const StageTime& stage : valueAs<std::vector<StageTime>>(stages)) {
    object[stage.stage] = stage.milliseconds;
  }
  return object;
}

Json stagesSchema() {
  return {{"type", "object"}, {"additionalProperties", {{"type", "number"}, {"minimum", 0}}}};
}

Result<FrameSpec> decodeFrameTree(const JsonNode& root, ProblemList problems) {
  FrameSpec spec;
  decodeValue(root, Notes{}, Place(), problems, spec);
  for (Problem& problem : problemsBeyond(problems.problems(), brokenRules(spec))) problems.add(std::move(problem));
  if (problems.empty()) return spec;
  return std::move(problems).take();
}

Result<FrameSpec> decodeFrameSpec(std::string_view json) {
  if (json.find_first_not_of(" \t\r\n") == std::string_view::npos) return FrameSpec{};
  ProblemList problems;
  const std::optional<JsonNode> root = readJson(json, problems);
  if (!root) return std::move(problems).take();
  return decodeFrameTree(*root, std::move(problems));
}

Result<SceneSummary> decodeSceneSummary(std::string_view json) {
  ProblemList problems;
  SceneSummary summary;
  if (const std::optional<JsonNode> root = readJson(json, problems)) {
    decodeValue(*root, Notes{}, Place(), problems, summary);
  }
  if (problems.empty()) return summary;
  return std::move(problems).take();
}

Json toJson(const FrameSpec& spec) {
  return encodeValue(spec);
}
Json toJson(const FrameReport& report) {
  return encodeValue(report);
}
Json toJson(const PlanReport& report) {
  return encodeValue(report);
}
Json toJson(const SceneSummary& summary) {
  return encodeValue(summary);
}
Json toJson(const RendererInfo& info) {
  return encodeValue(info);
}
Json toJson(const FrameReply& reply) {
  return encodeValue(reply);
}
Json toJson(const SceneList& list) {
  return encodeValue(list);
}
Json toJson(const Capabilities& capabilities) {
  return encodeValue(capabilities);
}

} // namespace gnomon
