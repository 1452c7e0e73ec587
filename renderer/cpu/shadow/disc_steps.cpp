#include "renderer/cpu/shadow/disc_steps.h"

#include <cmath>

namespace gnomon::cpu {
namespace {

constexpr double kGoldenAngle = 2.39996323;

glm::vec2 turned(double radius, int index) {
  return {radius * std::cos(index * kGoldenAngle), radius * std::sin(index * kGoldenAngle)};
}

std::array<glm::vec2, kDiscTaps> spiral() {
  std::array<glm::vec2, kDiscTaps> steps;
  for (int i = 0; i < kDiscTaps; ++i) steps[static_cast<std::size_t>(i)] = turned(std::sqrt((i + 0.5) / kDiscTaps), i);
  return steps;
}

glm::vec2 searched(int index) {
  const double share = index / (kSearchTaps - 1.0);
  return turned(share * share, index);
}

std::array<glm::vec2, kSearchTaps> searchSpiral() {
  std::array<glm::vec2, kSearchTaps> steps;
  for (int i = 0; i < kSearchTaps; ++i) steps[static_cast<std::size_t>(i)] = searched(i);
  return steps;
}

} // namespace

const std::array<glm::vec2, kDiscTaps>& discSteps() {
  static const std::array<glm::vec2, kDiscTaps> steps = spiral();
  return steps;
}

const std::array<glm::vec2, kSearchTaps>& searchSteps() {
  static const std::array<glm::vec2, kSearchTaps> steps = searchSpiral();
  return steps;
}

} // namespace gnomon::cpu
