#include "protocol/spec/validate.h"

#include <algorithm>
#include <string>

#include "protocol/fields/field_checks.h"
#include "protocol/spec/debug_light.h"
#include "protocol/spec/limits.h"
#include "protocol/spec/sun_steps.h"

namespace gnomon {
namespace {

void appendPixelRule(const FrameSpec& spec, std::vector<BrokenRule>& broken) {
  const std::int64_t pixels = std::int64_t{spec.width} * spec.height;
  if (pixels <= kLimits.maxFramePixels) return;
  broken.push_back({{.code = ProblemCode::tooLarge,
                     .pointer = "/width",
                     .detail = "Width times height is more than one frame may have.",
                     .limit = std::to_string(kLimits.maxFramePixels) + " pixels",
                     .actual = std::to_string(pixels) + " pixels"},
                    {"/width", "/height"}});
}

void appendFormatRules(const FrameSpec& spec, std::vector<BrokenRule>& broken) {
  constexpr int kMaxWebpSide = 16383; ///< of the format
  if (spec.output.format != ImageFormat::webp) return;
  const auto check = [&](int side, const char* pointer) {
    if (side <= kMaxWebpSide) return;
    broken.push_back({{.code = ProblemCode::tooLarge,
                       .pointer = pointer,
                       .detail = "A WebP can't be as wide or as high.",
                       .limit = std::to_string(kMaxWebpSide) + " pixels a side",
                       .actual = std::to_string(side) + " pixels"},
                      {pointer, "/output/format"}});
  };
  check(spec.width, "/width");
  check(spec.height, "/height");
}

void appendNodeRules(const std::vector<NodeOptions>& nodes, const std::string& list, std::vector<BrokenRule>& broken) {
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const std::string pointer = list + "/" + std::to_string(i);
    appendPlaceRules(nodes[i], pointer, broken);
    if (nodes[i].node) continue;
    broken.push_back(
        {invalidValue(pointer + "/node", "A node's index or name is needed.", "", "absent"), {pointer + "/node"}});
  }
}

void appendMotionRules(const FrameSpec& spec, std::vector<BrokenRule>& broken) {
  const bool shown = std::find(spec.views.begin(), spec.views.end(), View::motion) != spec.views.end();
  if (shown && !spec.motionFrom) {
    broken.push_back({invalidValue("/motionFrom", "The view motion needs an earlier moment.",
                                   "camera, animation or nodes", "absent"),
                      {"/views", "/motionFrom"}});
  }
  if (!spec.motionFrom) return;
  const MotionFrom& from = *spec.motionFrom;
  if (from.camera) appendCameraRules(*from.camera, "/motionFrom/camera", broken);
  if (from.animation) appendAnimationRules(*from.animation, "/motionFrom/animation", broken);
  if (!from.nodes) return;
  appendNodeRules(*from.nodes, "/motionFrom/nodes", broken);
  for (std::size_t i = 0; i < from.nodes->size(); ++i) {
    const NodeOptions& node = (*from.nodes)[i];
    if (!node.visible && !node.castShadow && !node.receiveShadow && !node.layers) continue;
    const std::string pointer = "/motionFrom/nodes/" + std::to_string(i);
    broken.push_back({invalidValue(pointer, "An earlier moment has places of nodes, and no switches.",
                                   "matrix | translation, rotation, scale"),
                      {pointer}});
  }
}

void appendBoxRules(const VolumeBox& box, const std::string& pointer, std::vector<BrokenRule>& broken) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (box.min[axis] < box.max[axis]) continue;
    const std::string at = "/" + std::to_string(axis);
    broken.push_back({invalidValue(pointer + "/max" + at, "A box needs an inside.",
                                   "more than " + numberText(box.min[axis]), numberText(box.max[axis])),
                      {pointer + "/min", pointer + "/max"}});
  }
}

void appendVolumeRules(const VolumeOptions& volume, const std::string& pointer, std::vector<BrokenRule>& broken) {
  const auto require = [&](bool given, const char* name, const char* detail) {
    if (!given) broken.push_back({invalidValue(pointer + name, detail, "", "absent"), {pointer + name}});
  };
  require(!volume.file.empty(), "/file", "A volume needs the name of a file.");
  require(!volume.transferFunction.empty(), "/transferFunction", "A volume needs a transfer function.");
  const bool placedTwice = volume.box && volume.matrix;
  if (placedTwice || !(volume.box || volume.matrix || volume.node)) {
    broken.push_back(
        {invalidValue(pointer, "A volume needs a box, a matrix or a node, and not both a box and a matrix.",
                      "box | matrix, at a node or not", placedTwice ? "both" : "none of them"),
         {pointer + "/box", pointer + "/matrix"}});
  }
  if (volume.box) appendBoxRules(*volume.box, pointer + "/box", broken);
  for (std::size_t i = 1; i < volume.transferFunction.size(); ++i) {
    const double before = volume.transferFunction[i - 1].value, value = volume.transferFunction[i].value;
    if (before < value) continue;
    const std::string at = pointer + "/transferFunction/" + std::to_string(i) + "/value";
    broken.push_back({invalidValue(at, "The values of a transfer function ascend.", "more than " + numberText(before),
                                   numberText(value)),
                      {at, pointer + "/transferFunction/" + std::to_string(i - 1) + "/value"}});
  }
}

void appendEnvironmentRules(const EnvironmentOptions& environment, std::vector<BrokenRule>& broken) {
  const int named = environment.file.has_value() + environment.sky.has_value() + environment.light.has_value();
  if (named < 2) return;
  broken.push_back({invalidValue("/environment", "An environment is one of a file, a sky and a light.",
                                 "file | sky | light", std::to_string(named) + " of them"),
                    {"/environment/file", "/environment/sky", "/environment/light"}});
}

void appendEnvironmentViews(const FrameSpec& spec, std::vector<BrokenRule>& broken) {
  if (std::get<std::string>(*spec.debug.light) != kEnvironmentName) {
    broken.push_back({invalidValue("/debug/light", "Debug views show a light, by its index, or the environment.",
                                   "an index | environment", std::get<std::string>(*spec.debug.light)),
                      {"/debug/light"}});
  } else if (spec.environment.shadows != EnvironmentShadows::rays) {
    broken.push_back({invalidValue("/debug/light", "The environment has no shadow without environment.shadows rays.",
                                   "environment.shadows rays", kEnvironmentName),
                      {"/debug/light", "/environment/shadows"}});
  }
}

void appendDebugRules(const FrameSpec& spec, std::vector<BrokenRule>& broken) {
  if (showsEnvironment(spec.debug)) appendEnvironmentViews(spec, broken);
  const auto light = debugLightIndex(spec.debug);
  if (!light || !spec.lights) return;
  const int count = static_cast<int>(spec.lights->size());
  if (*light < count) return;
  broken.push_back({invalidValue("/debug/light", "The frame has no light of that index.",
                                 count == 0 ? "no lights" : "0.." + std::to_string(count - 1), std::to_string(*light)),
                    {"/lights"}});
}

void appendQualityRules(const Quality& quality, std::vector<BrokenRule>& broken) {
  if (quality.maxError.has_value() != quality.maxMilliseconds.has_value()) return;
  broken.push_back({invalidValue("/quality", "A target needs exactly one of maxError and maxMilliseconds.",
                                 "maxError | maxMilliseconds", quality.maxError ? "both" : "neither"),
                    {"/quality"}});
}

} // namespace

std::vector<BrokenRule> brokenRules(const FrameSpec& spec) {
  std::vector<BrokenRule> broken;
  appendPixelRule(spec, broken);
  appendFormatRules(spec, broken);
  appendCameraRules(spec.camera, "/camera", broken);
  if (spec.animation) appendAnimationRules(*spec.animation, "/animation", broken);
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
  appendNodeRules(spec.nodes, "/nodes", broken);
  appendEnvironmentRules(spec.environment, broken);
  appendMotionRules(spec, broken);
  appendSunHoursRules(spec, broken);
  for (std::size_t i = 0; i < spec.volumes.size(); ++i) {
    appendVolumeRules(spec.volumes[i], "/volumes/" + std::to_string(i), broken);
  }
  if (spec.environment.sky) appendSunRules(spec.environment.sky->sun, "/environment/sky/sun", broken);
  appendDebugRules(spec, broken);
  if (spec.quality) appendQualityRules(*spec.quality, broken);
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
