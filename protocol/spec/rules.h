#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "protocol/spec/scene_options.h"
#include "protocol/spec/shadow_options.h"
#include "protocol/spec/validate.h"
#include "protocol/spec/volume_options.h"

/// Rules across fields, one function for each part of a request. brokenRules (validate.h) calls them all.
namespace gnomon {

// view_rules.cpp

/// One of index and name, and a time only with them.
void appendAnimationRules(const AnimationMoment& moment, const std::string& pointer, std::vector<BrokenRule>& broken);

/// Of one camera at `pointer`.
void appendCameraRules(const Camera& camera, const std::string& pointer, std::vector<BrokenRule>& broken);

/// Where an entry of `nodes` puts its node.
void appendPlaceRules(const NodeOptions& node, const std::string& pointer, std::vector<BrokenRule>& broken);

/// At "/lights/<index>", without the rules of its shadow.
void appendLightRules(const Light& light, std::size_t index, std::vector<BrokenRule>& broken);

// shadow_rules.cpp

/// Texels along a side of a cascade's tile.
int tileSide(ShadowSize size, const Atlas& atlas);

void appendAtlasRules(const Atlas& atlas, std::vector<BrokenRule>& broken);

/// Of one shadow at `pointer`.
void appendShadowRules(const Shadow& shadow, const Atlas& atlas, const std::string& pointer,
                       std::vector<BrokenRule>& broken);

// volume_rules.cpp

/// Of one volume at `pointer`.
void appendVolumeRules(const VolumeOptions& volume, const std::string& pointer, std::vector<BrokenRule>& broken);

} // namespace gnomon
