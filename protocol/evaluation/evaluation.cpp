#include "protocol/evaluation/evaluation.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "protocol/fields/field_codec.h"
#include "protocol/fields/field_list.h"
#include "protocol/spec/validate.h"

namespace gnomon {
namespace {

bool isField(const std::string& path) {
  static const std::vector<FieldEntry> fields = frameFields();
  return std::any_of(fields.begin(), fields.end(), [&](const FieldEntry& field) {
    return field.path.starts_with(path) &&
           (field.path.size() == path.size() || field.path[path.size()] == '.' || field.path[path.size()] == '[');
  });
}

void checkRemovalsAt(const Json& patch, const std::string& path, const Place& place, ProblemList& problems) {
  for (const auto& [key, value] : patch.items()) {
    const Place inner(place, key);
    const std::string innerPath = path.empty() ? key : path + "." + key;
    if (value.is_object()) checkRemovalsAt(value, innerPath, inner, problems);
    if (!value.is_null() || isField(innerPath)) continue;
    problems.add(invalidValue(inner.pointer(), "Unknown field; nothing to remove."));
  }
}

} // namespace

Problems within(Problems problems, const std::string& place) {
  for (Problem& problem : problems) problem.pointer.insert(0, place);
  return problems;
}

void checkRemovals(const Json& patch, ProblemList& problems) {
  checkRemovalsAt(patch, "", Place(), problems);
}

void checkSpecRules(const FrameSpec& spec, ProblemList& problems) {
  std::vector<BrokenRule> rules = brokenRules(spec);
  for (BrokenRule& rule : rules) {
    rule.problem.pointer.insert(0, "/spec");
    for (std::string& read : rule.reads) read.insert(0, "/spec");
  }
  for (Problem& problem : problemsBeyond(problems.problems(), rules)) problems.add(std::move(problem));
}

Json writtenSpec(const Json& request) {
  const auto spec = request.find("spec");
  return spec != request.end() && spec->is_object() ? *spec : Json::object();
}

void addPatchProblems(const Problems& found, const Problems& known, const std::string& place, ProblemList& problems) {
  for (const Problem& problem : found) {
    const bool isKnown = std::any_of(known.begin(), known.end(), [&](const Problem& earlier) {
      return earlier.pointer == "/spec" + problem.pointer;
    });
    if (!isKnown) problems.add(within({problem}, place).front());
  }
}

namespace {

/// What is wrong with a path besides its values.
void checkPath(const CameraPath& path, ProblemList& problems) {
  if (path.cameras.has_value() == path.step.has_value()) {
    problems.add(
        invalidValue("/path", "Give either `cameras` or `step`.", "cameras | step", path.step ? "both" : "neither"));
  } else if (path.frames && !path.step) {
    problems.add(invalidValue("/path/frames", "frames counts steps; a list of cameras has its own length."));
  }
  for (std::size_t i = 0; path.cameras && i < path.cameras->size(); ++i) {
    std::vector<BrokenRule> broken;
    appendCameraRules((*path.cameras)[i], "/path/cameras/" + std::to_string(i), broken);
    for (BrokenRule& rule : broken) problems.add(std::move(rule.problem));
  }
}

Problem targetProblem(const std::string& pointer) {
  return invalidValue(pointer, "An evaluation measures given settings: leave out the target `quality`.");
}

/// Reads variants over a spec that may have problems of its own, which are not reported again.
class VariantReader {
 public:
  VariantReader(const Json& spec, ProblemList& problems)
      : spec_(spec), problems_(problems), known_(problems.problems()) {}

  /// What `patch` makes of the spec; its problems, put at `place`, where it gives no good one.
  void read(const std::string& name, const Json& patch, const std::string& place, std::vector<Variant>& variants) {
    Json merged = spec_;
    merged.merge_patch(patch);
    const Result<FrameSpec> spec = decodeFrameSpec(merged.dump());
    if (!spec) {
      addPatchProblems(spec.problems(), known_, place, problems_);
    } else if (spec->quality) {
      if (!spec_.contains("quality")) problems_.add(targetProblem(place + "/quality"));
    } else {
      variants.push_back({{patch.dump()}, name, *spec});
    }
  }

 private:
  const Json& spec_;
  ProblemList& problems_;
  const Problems known_;
};

std::vector<Variant> readVariants(const EvaluationRequest& request, const Json& spec, ProblemList& problems) {
  std::vector<Variant> variants;
  VariantReader reader(spec, problems);
  if (request.sweep) {
    for (const SweepVariant& each : sweepVariants(*request.sweep, spec)) {
      reader.read(each.name, each.patch, "/sweep", variants);
    }
    return variants;
  }
  for (std::size_t i = 0; i < request.variants->size(); ++i) {
    const Json patch = Json::parse((*request.variants)[i].json);
    const std::string place = "/variants/" + std::to_string(i);
    ProblemList removals;
    checkRemovals(patch, removals);
    for (Problem& problem : within(std::move(removals).take(), place)) problems.add(std::move(problem));
    reader.read(variantName(patch), patch, place, variants);
  }
  return variants;
}

} // namespace

bool decodePatch(const JsonNode& node, const Place& place, ProblemList& problems, void* out) {
  if (!std::holds_alternative<JsonNode::Object>(node.value)) return addWrongType(node, "an object", place, problems);
  valueAs<SpecPatch>(out).json = jsonOf(node).dump();
  return true;
}

Json encodePatch(const void* patch) {
  return Json::parse(valueAs<SpecPatch>(patch).json);
}

Json patchSchema() {
  return {{"type", "object"}, {"description", "A JSON merge patch (RFC 7396) over a FrameSpec."}};
}

Result<Evaluation> decodeEvaluation(std::string_view json) {
  ProblemList problems;
  const std::optional<JsonNode> root = readJson(json, problems);
  if (!root) return std::move(problems).take();
  EvaluationRequest request;
  decodeValue(*root, Notes{}, Place(), problems, request);
  checkSpecRules(request.spec, problems);
  const bool goodPath = std::none_of(problems.problems().begin(), problems.problems().end(),
                                     [](const Problem& problem) { return pointsInto(problem.pointer, "/path"); });
  if (request.path && goodPath) checkPath(*request.path, problems);
  if (request.spec.quality) problems.add(targetProblem("/spec/quality"));

  Evaluation evaluation{request.spec, {}, request.repeats, request.referenceSamples, request.path};
  const Json document = jsonOf(*root);
  const bool given[] = {document.contains("variants"), document.contains("sweep")};
  if (document.is_object() && given[0] == given[1]) {
    problems.add(
        invalidValue("", "Give either `variants` or `sweep`.", "variants | sweep", given[0] ? "both" : "neither"));
  } else if (request.variants || request.sweep) {
    evaluation.variants = readVariants(request, writtenSpec(document), problems);
  }
  if (problems.empty()) return evaluation;
  return std::move(problems).take();
}

std::optional<EvaluationReport> readEvaluationReport(std::string_view json) {
  auto report = readReply<EvaluationReport>(json, {"rows"});
  return report && !report->rows.empty() ? report : std::nullopt;
}

} // namespace gnomon
