#include <string>

#include "protocol/fields/field_checks.h"
#include "protocol/spec/rules.h"

namespace gnomon {
namespace {

void appendBoxRules(const VolumeBox& box, const std::string& pointer, std::vector<BrokenRule>& broken) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (box.min[axis] < box.max[axis]) continue;
    const std::string at = "/" + std::to_string(axis);
    broken.push_back({{ProblemCode::invalidValue, pointer + "/max" + at, "A box needs an inside.",
                       "more than " + numberText(box.min[axis]), numberText(box.max[axis])},
                      {pointer + "/min", pointer + "/max"}});
  }
}

} // namespace

void appendVolumeRules(const VolumeOptions& volume, const std::string& pointer, std::vector<BrokenRule>& broken) {
  const auto require = [&](bool given, const char* name, const char* detail) {
    if (!given) broken.push_back({{ProblemCode::invalidValue, pointer + name, detail, "", "absent"}, {pointer + name}});
  };
  require(!volume.file.empty(), "/file", "A volume needs the name of a file.");
  require(!volume.transferFunction.empty(), "/transferFunction", "A volume needs a transfer function.");
  const bool placedTwice = volume.box && volume.matrix;
  if (placedTwice || !(volume.box || volume.matrix || volume.node)) {
    broken.push_back({{ProblemCode::invalidValue, pointer,
                       "A volume needs a box, a matrix or a node, and not both a box and a matrix.",
                       "box | matrix, at a node or not", placedTwice ? "both" : "none of them"},
                      {pointer + "/box", pointer + "/matrix"}});
  }
  if (volume.box) appendBoxRules(*volume.box, pointer + "/box", broken);
  for (std::size_t i = 1; i < volume.transferFunction.size(); ++i) {
    const double before = volume.transferFunction[i - 1].value, value = volume.transferFunction[i].value;
    if (before < value) continue;
    const std::string at = pointer + "/transferFunction/" + std::to_string(i) + "/value";
    broken.push_back({{ProblemCode::invalidValue, at, "The values of a transfer function ascend.",
                       "more than " + numberText(before), numberText(value)},
                      {at, pointer + "/transferFunction/" + std::to_string(i - 1) + "/value"}});
  }
}

} // namespace gnomon
