#pragma once

#include <array>
#include <glm/glm.hpp>

namespace gnomon::cpu {

inline constexpr int kDiscTaps = 32;

/// The taps of a disc of radius 1, before a pixel turns them: Vogel's spiral, equal areas.
const std::array<glm::vec2, kDiscTaps>& discSteps();

inline constexpr int kSearchTaps = 32;

/// The places of a search within a radius of 1, the same way: from the middle outwards, the farther the sparser.
const std::array<glm::vec2, kSearchTaps>& searchSteps();

} // namespace gnomon::cpu
