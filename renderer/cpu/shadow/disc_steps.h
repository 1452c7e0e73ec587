#pragma once

#include <array>
#include <glm/glm.hpp>

#include "renderer/shaders/shared/frame_types.h"

namespace gnomon::cpu {

/// The taps of a disc of radius 1, before a pixel turns them: Vogel's spiral, equal areas.
const std::array<glm::vec2, GNOMON_DISC_TAPS>& discSteps();

/// The places of a search within a radius of 1, the same way: from the middle outwards, the farther the sparser.
const std::array<glm::vec2, GNOMON_SEARCH_TAPS>& searchSteps();

} // namespace gnomon::cpu
