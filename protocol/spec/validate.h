#pragma once

#include <string>
#include <vector>

#include "protocol/base/result.h"
#include "protocol/spec/frame_spec.h"

namespace gnomon {

/// What is wrong with a spec, however it was made: each value against its row, and where all are good, the rules across
/// fields. decodeFrameSpec has done this already. Empty = it can be rendered, as far as is known without a scene.
Problems validate(const FrameSpec& spec);

/// A rule across fields that a spec breaks.
struct BrokenRule {
  Problem problem;
  std::vector<std::string> reads; ///< pointers of the fields that it looks at; with one of them wrong it means nothing
};

/// The rules across fields alone; every value is taken to be within its row's bounds.
std::vector<BrokenRule> brokenRules(const FrameSpec& spec);

/// The problems of those broken rules whose fields are not among `found` already.
Problems problemsBeyond(const Problems& found, const std::vector<BrokenRule>& broken);

} // namespace gnomon
