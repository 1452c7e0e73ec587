#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "protocol/base/result.h"
#include "protocol/spec/frame_spec.h"
#include "protocol/spec/scene_options.h"
#include "protocol/spec/shadow_options.h"

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

// view_rules.cpp

/// One of index and name, and a time only with them.
void appendAnimationRules(const AnimationMoment& moment, const std::string& pointer, std::vector<BrokenRule>& broken);

/// Of one camera at `pointer`.
void appendCameraRules(const Camera& camera, const std::string& pointer, std::vector<BrokenRule>& broken);

/// Where an entry of `nodes` puts its node.
void appendPlaceRules(const NodeOptions& node, const std::string& pointer, std::vector<BrokenRule>& broken);

/// At "/lights/<index>", without the rules of its shadow.
void appendLightRules(const Light& light, std::size_t index, std::vector<BrokenRule>& broken);

// sun_rules.cpp

/// Of one sun at `pointer`: a place and a time, or azimuth and elevation.
void appendSunRules(const Sun& sun, const std::string& pointer, std::vector<BrokenRule>& broken);

// shadow_rules.cpp

/// Texels along a side of a cascade's tile.
int tileSide(ShadowSize size, const Atlas& atlas);

void appendAtlasRules(const Atlas& atlas, std::vector<BrokenRule>& broken);

/// Of one shadow at `pointer`.
void appendShadowRules(const Shadow& shadow, const Atlas& atlas, const std::string& pointer,
                       std::vector<BrokenRule>& broken);

} // namespace gnomon
