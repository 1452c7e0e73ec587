#pragma once

#include <array>
#include <glm/glm.hpp>

namespace gnomon::cpu {

inline constexpr int kDiscTaps = 32;

/// The taps of a disc of radius 1, before a pixel turns them: Vogel's spiral, equal areas.
const std::array<glm::vec2, kDiscTaps>& discSteps();

} // namespace gnomon::cpu
