#include "protocol/validate.h"

#include <algorithm>

#include "protocol/field_checks.h"
#include "protocol/field_rows.h"
#include "protocol/shadow_rules.h"
#include "protocol/view_rules.h"

namespace gnomon {
namespace {

void appendPixelRule(const FrameSpec& spec, std::vector<BrokenRule>& broken) {
  const std::int64_t pixels = std::int64_t{spec.width} * spec.height;
  if (pixels <= kLimits.maxFramePixels) return;
  broken.push_back({{.code = ProblemCode::tooLarge,
                     .pointer = "/width",
                     .detail = "width times height is more than one frame may have.",
                     .limit = std::to_string(kLimits.maxFramePixels) + " pixels",
                     .actual = std::to_string(pixels) + " pixels"},
                    {"/width", "/height"}});
}

} // namespace

std::vector<BrokenRule> brokenRules(const FrameSpec& spec) {
  std::vector<BrokenRule> broken;
  appendPixelRule(spec, broken);
  appendCameraRules(spec.camera, broken);
  if (spec.lights) {
    for (std::size_t i = 0; i < spec.lights->size(); ++i) {
      const Light& light = (*spec.lights)[i];
      appendLightRules(light, i, broken);
      if (light.shadow) {
        appendShadowRules(*light.shadow, spec.atlas, "/lights/" + std::to_string(i) + "/shadow", broken);
      }
    }
  }
  appendShadowRules(spec.shadow, spec.atlas, "/shadow", broken);
  appendAtlasRules(spec.atlas, broken);
  return broken;
}

Problems problemsBeyond(const Problems& found, const std::vector<BrokenRule>& broken) {
  const auto isWrong = [&](const std::string& pointer) {
    return std::any_of(found.begin(), found.end(), [&](const Problem& problem) {
      return pointsInto(problem.pointer, pointer) || pointsInto(pointer, problem.pointer);
    });
  };
  Problems result;
  for (const BrokenRule& rule : broken) {
    if (std::none_of(rule.reads.begin(), rule.reads.end(), isWrong)) result.push_back(rule.problem);
  }
  return result;
}

Problems validate(const FrameSpec& spec) {
  ProblemList problems;
  checkAll(spec, Notes{}, Place(), problems);
  if (problems.empty()) {
    for (BrokenRule& rule : brokenRules(spec)) problems.add(std::move(rule.problem));
  }
  return std::move(problems).take();
}

} // namespace gnomon
