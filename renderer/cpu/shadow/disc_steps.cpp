#include "renderer/cpu/shadow/disc_steps.h"

#include <cmath>

namespace gnomon::cpu {
namespace {

/// `radiusOf(i)`: of the place of that number.
template <std::size_t count, class RadiusOf>
std::array<glm::vec2, count> spiral(const RadiusOf& radiusOf) {
  std::array<glm::vec2, count> steps;
  for (std::size_t i = 0; i < count; ++i) {
    const double place = static_cast<double>(i), radius = radiusOf(place);
    steps[i] = {radius * std::cos(place * GNOMON_GOLDEN_ANGLE), radius * std::sin(place * GNOMON_GOLDEN_ANGLE)};
  }
  return steps;
}

} // namespace

const std::array<glm::vec2, GNOMON_DISC_TAPS>& discSteps() {
  static const auto steps =
      spiral<GNOMON_DISC_TAPS>([](double place) { return std::sqrt((place + 0.5) / GNOMON_DISC_TAPS); });
  return steps;
}

const std::array<glm::vec2, GNOMON_SEARCH_TAPS>& searchSteps() {
  static const auto steps = spiral<GNOMON_SEARCH_TAPS>([](double place) {
    const double share = place / (GNOMON_SEARCH_TAPS - 1.0);
    return share * share;
  });
  return steps;
}

} // namespace gnomon::cpu
