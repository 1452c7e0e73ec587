#pragma once

#include <string>
#include <vector>

#include "protocol/spec/shadow_options.h"
#include "protocol/spec/validate.h"

namespace gnomon {

/// Texels along a side of a cascade's tile.
int tileSide(ShadowSize size, const Atlas& atlas);

/// Rules across the fields of the atlas and of one shadow that stands at `pointer`.
void appendAtlasRules(const Atlas& atlas, std::vector<BrokenRule>& broken);
void appendShadowRules(const Shadow& shadow, const Atlas& atlas, const std::string& pointer,
                       std::vector<BrokenRule>& broken);

} // namespace gnomon
