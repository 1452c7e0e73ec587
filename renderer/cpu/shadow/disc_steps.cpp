#include "renderer/cpu/shadow/disc_steps.h"

#include <cmath>

namespace gnomon::cpu {
namespace {

constexpr double kGoldenAngle = 2.39996323;

std::array<glm::vec2, kDiscTaps> spiral() {
  std::array<glm::vec2, kDiscTaps> steps;
  for (int i = 0; i < kDiscTaps; ++i) {
    const double radius = std::sqrt((i + 0.5) / kDiscTaps);
    steps[static_cast<std::size_t>(i)] =
        glm::vec2(radius * std::cos(i * kGoldenAngle), radius * std::sin(i * kGoldenAngle));
  }
  return steps;
}

} // namespace

const std::array<glm::vec2, kDiscTaps>& discSteps() {
  static const std::array<glm::vec2, kDiscTaps> steps = spiral();
  return steps;
}

} // namespace gnomon::cpu
