#include "protocol/evaluation/patch_checks.h"

#include <algorithm>
#include <vector>

#include "protocol/fields/field_list.h"
#include "protocol/spec/rules.h"
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
    problems.add(
        {.code = ProblemCode::invalidValue, .pointer = inner.pointer(), .detail = "Unknown field; nothing to remove."});
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

} // namespace gnomon
