#pragma once

#include <string_view>
#include <vector>

#include "protocol/spec/frame_spec.h"

namespace gnomon {

/// The settings of a light's shadow, as members of `shadow`, that differ from their defaults and that nothing reads:
/// its technique, filter, type or size has no use for them. `mapped`: whether its shadow map is planned or drawn,
/// whatever decides the shadow. REQUIRES: the shadow is set, its technique is not auto.
std::vector<std::string_view> unusedSettings(const Light& light, bool mapped);

} // namespace gnomon
