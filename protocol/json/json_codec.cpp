#include "protocol/json/json_codec.h"

#include <cassert>
#include <nlohmann/json.hpp>

#include "protocol/base/text.h"
#include "protocol/fields/field_codec.h"
#include "protocol/fields/fields.h"
#include "protocol/json/problem_rows.h"
#include "protocol/report/frame_report.h"
#include "protocol/spec/validate.h"

namespace gnomon {

bool decodeStages(const JsonNode& node, const Place& place, ProblemList& problems, void* out) {
  const auto* object = std::get_if<JsonNode::Object>(&node.value);
  if (!object) return addWrongType(node, "an object", place, problems);
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
  if (json.empty()) return FrameSpec{};
  ProblemList problems;
  const std::optional<JsonNode> root = readJson(json, problems);
  if (!root) return std::move(problems).take();
  return decodeFrameTree(*root, std::move(problems));
}

Result<SceneSummary> decodeSceneSummary(std::string_view json) {
  return decodeJson<SceneSummary>(json);
}

std::optional<NodePage> readNodePage(std::string_view json) {
  const auto page = decodeJson<NodePage>(json);
  return page ? std::optional(*page) : std::nullopt;
}

std::optional<QualityReport> readQualityReport(std::string_view json) {
  auto report = decodeJson<QualityReport>(json);
  if (!report || report->chosen >= report->tried.size()) return std::nullopt;
  return *std::move(report);
}

std::string jsonText(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

namespace {

Json entry(const Problem& problem) {
  Json json = {{"code", std::string(problemName(problem.code))},
               {"pointer", asUtf8(problem.pointer)},
               {"detail", asUtf8(problem.detail)}};
  if (!problem.limit.empty()) json["limit"] = asUtf8(problem.limit);
  if (!problem.actual.empty()) json["actual"] = asUtf8(problem.actual);
  return json;
}

Json textSchema(const char* description) {
  return {{"type", "string"}, {"description", description}};
}

} // namespace

std::string_view problemName(ProblemCode code) {
  return spell(code);
}

std::string_view problemTitle(ProblemCode code) {
  return kSpellings<ProblemCode>[static_cast<std::size_t>(code)].says;
}

Json problemJson(const Problems& problems, int status, std::string_view instance) {
  assert(!problems.empty());
  const Problem& first = problems.front();
  std::string detail = asUtf8(first.detail);
  if (problems.size() > 1) {
    const bool isAll = problems.size() <= ProblemList::kMax; // else the last one says that there are more
    const std::string count =
        isAll ? std::to_string(problems.size()) : "more than " + std::to_string(ProblemList::kMax);
    detail = "There are " + count + " problems, the first at \"" + asUtf8(first.pointer) + "\": " + detail;
  }
  Json json = {{"type", "/problems/" + std::string(problemName(first.code))},
               {"title", std::string(problemTitle(first.code))},
               {"status", status},
               {"detail", detail}};
  if (!instance.empty()) json["instance"] = asUtf8(instance);
  json["problems"] = Json::array();
  for (const Problem& problem : problems) json["problems"].push_back(entry(problem));
  return json;
}

Json problemSchema() {
  Json codes = Json::array();
  for (const Spelling& spelling : kSpellings<ProblemCode>) codes.push_back(std::string(spelling.name));
  const Json item = {
      {"type", "object"},
      {"description", "One thing that is wrong."},
      {"additionalProperties", false},
      {"required", {"code", "pointer", "detail"}},
      {"properties",
       {{"code", {{"type", "string"}, {"enum", codes}, {"description", "What kind of thing is wrong."}}},
        {"pointer", textSchema("Where: a JSON pointer, a query key or a part's name; empty = the whole.")},
        {"detail", textSchema("One sentence for people.")},
        {"limit", textSchema("What would have been accepted.")},
        {"actual", textSchema("What came, shortened.")}}}};
  return {{"type", "object"},
          {"description", "Everything that is wrong with a request, as RFC 9457 has it."},
          {"additionalProperties", false},
          {"required", {"type", "title", "status", "detail", "problems"}},
          {"properties",
           {{"type", textSchema("/problems/ and the first problem's code.")},
            {"title", textSchema("The first problem's code in words, such as Too Many Requests.")},
            {"status", {{"type", "integer"}, {"description", "The HTTP status."}}},
            {"detail", textSchema("The first problem, for people, and how many there are.")},
            {"instance", textSchema("The request's id.")},
            {"problems", {{"type", "array"}, {"minItems", 1}, {"items", item}, {"description", "Every problem."}}}}}};
}

} // namespace gnomon
