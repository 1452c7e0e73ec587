#include "renderer/cpu/shadow/disc_steps.h"

#include <cmath>

namespace gnomon::cpu {
namespace {

glm::vec2 turned(double radius, int index) {
  return {radius * std::cos(index * GNOMON_GOLDEN_ANGLE), radius * std::sin(index * GNOMON_GOLDEN_ANGLE)};
}

std::array<glm::vec2, GNOMON_DISC_TAPS> spiral() {
  std::array<glm::vec2, GNOMON_DISC_TAPS> steps;
  for (int i = 0; i < GNOMON_DISC_TAPS; ++i)
    steps[static_cast<std::size_t>(i)] = turned(std::sqrt((i + 0.5) / GNOMON_DISC_TAPS), i);
  return steps;
}

glm::vec2 searched(int index) {
  const double share = index / (GNOMON_SEARCH_TAPS - 1.0);
  return turned(share * share, index);
}

std::array<glm::vec2, GNOMON_SEARCH_TAPS> searchSpiral() {
  std::array<glm::vec2, GNOMON_SEARCH_TAPS> steps;
  for (int i = 0; i < GNOMON_SEARCH_TAPS; ++i) steps[static_cast<std::size_t>(i)] = searched(i);
  return steps;
}

} // namespace

const std::array<glm::vec2, GNOMON_DISC_TAPS>& discSteps() {
  static const std::array<glm::vec2, GNOMON_DISC_TAPS> steps = spiral();
  return steps;
}

const std::array<glm::vec2, GNOMON_SEARCH_TAPS>& searchSteps() {
  static const std::array<glm::vec2, GNOMON_SEARCH_TAPS> steps = searchSpiral();
  return steps;
}

} // namespace gnomon::cpu
