#pragma once

#include <compare>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "renderer/scene/animation/motion.h"
#include "renderer/scene/findings.h"
#include "renderer/scene/geometry/accessor_view.h"

namespace gnomon {

/// What a sampler's values are: it may serve several.
struct SamplerUse {
  ChannelPath path = ChannelPath::translation;
  std::size_t weights = 1; ///< values a keyframe: of the path weights one a morph target

  auto operator<=>(const SamplerUse&) const = default;
};

/// Reads a sampler, at most `mostNumbers` of them; without times, and with a problem, where it breaks a rule.
Sampler buildSampler(const nlohmann::json& source, const std::string& pointer,
                     const std::vector<AccessorView>& accessors, const SamplerUse& use, std::size_t mostNumbers,
                     Findings& findings);

} // namespace gnomon
