// Error metrics of pictures drawn at random, held against the definitions worked out pixel by pixel.
#include <cmath>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "renderer/reference/error_measures.h"
#include "tests/renderer/reference/made_reference.h"

namespace gnomon {
namespace {

/// A plane in two levels, far enough apart to be two surfaces, with shadows and receivers at random.
struct RandomTruth {
  Reference truth;
  std::vector<float> shown;
};

float randomShare(int lightsIn10) {
  const float share = 0.05f * static_cast<float>(*rc::gen::inRange(0, 10));
  return *rc::gen::inRange(0, 10) < lightsIn10 ? 1.0f - share : share;
}

RandomTruth randomTruth() {
  const int width = *rc::gen::inRange(1, 16);
  const int height = *rc::gen::inRange(1, 16);
  const int lightsIn10 = *rc::gen::element(1, 5, 9);
  const int receiversIn10 = *rc::gen::element(0, 5, 10);
  const auto picture = [&] {
    return testing::pictureOf(width, height, [&](int, int) { return randomShare(lightsIn10); });
  };
  RandomTruth random{testing::planeReference(width, height, picture()), picture()};
  LightReference& light = random.truth.lights[0];
  for (std::size_t i = 0; i < random.shown.size(); ++i) {
    light.receiver[i] = *rc::gen::inRange(0, 10) < receiversIn10 ? 1 : 0;
    if (light.visibility[i] < 0.5f) light.blockerDistance[i] = static_cast<float>(*rc::gen::inRange(0, 5));
    if (*rc::gen::inRange(0, 10) == 0) random.truth.surface[i].position.y = -50;
    if (*rc::gen::inRange(0, 20) == 0) random.truth.surface[i].instance = kNoSurface;
  }
  return random;
}

/// The definitions as they stand, every pixel against every other.
struct BruteForce {
  const Reference& truth;
  const LightReference& light;
  std::span<const float> shown;

  bool edge(std::span<const float> values, std::size_t at) const {
    const int x = static_cast<int>(at) % truth.width;
    const int y = static_cast<int>(at) / truth.width;
    for (std::size_t other = 0; other < values.size(); ++other) {
      const int apart =
          std::abs(static_cast<int>(other) % truth.width - x) + std::abs(static_cast<int>(other) / truth.width - y);
      if (apart != 1 || light.receiver[at] == 0 || light.receiver[other] == 0) continue;
      const SurfacePoint& a = truth.surface[at];
      const SurfacePoint& b = truth.surface[other];
      const bool same = a.instance != kNoSurface && b.instance != kNoSurface && a.position.y == b.position.y;
      if (same && (values[at] >= 0.5f) != (values[other] >= 0.5f)) return true;
    }
    return false;
  }

  double toEdge(std::size_t at, bool anySide, bool lit) const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t other = 0; other < shown.size(); ++other) {
      if (!edge(light.visibility, other)) continue;
      if (!anySide && (light.visibility[other] >= 0.5f) != lit) continue;
      const int dx = static_cast<int>(other) % truth.width - static_cast<int>(at) % truth.width;
      const int dy = static_cast<int>(other) / truth.width - static_cast<int>(at) / truth.width;
      least = std::min(least, std::sqrt(static_cast<double>(dx * dx + dy * dy)));
    }
    return least;
  }
};

RC_GTEST_PROP(ErrorProperties, H1_MetricsAreTheirDefinitions, ()) {
  const RandomTruth random = randomTruth();
  const LightReference& light = random.truth.lights[0];
  const BruteForce brute{random.truth, light, random.shown};
  double receivers = 0, falseShadow = 0, falseLit = 0, acne = 0, leak = 0, interior = 0, absolute = 0, squared = 0;
  std::vector<double> displacements;
  for (std::size_t i = 0; i < random.shown.size(); ++i) {
    if (light.receiver[i] == 0) continue;
    const bool lit = random.shown[i] >= 0.5f;
    const bool trulyLit = light.visibility[i] >= 0.5f;
    const double difference = static_cast<double>(random.shown[i]) - light.visibility[i];
    const bool inside = brute.toEdge(i, true, false) > 2;
    const bool wrong = lit != trulyLit;
    receivers += 1;
    absolute += std::abs(difference);
    squared += difference * difference;
    falseShadow += wrong && trulyLit;
    falseLit += wrong && lit;
    interior += wrong && inside;
    acne += wrong && trulyLit && inside;
    leak += wrong && lit && (inside || light.blockerDistance[i] < 2);
    if (brute.edge(random.shown, i)) displacements.push_back(brute.toEdge(i, false, lit));
  }
  const ErrorMetrics errors = measureErrors(random.truth, std::span(&random.shown, 1));
  RC_ASSERT(static_cast<double>(errors.receivers) == receivers);
  const auto shareIs = [&](double value, double count) {
    return receivers == 0 ? value == 0 : std::abs(value - count / receivers) < 1e-12;
  };
  RC_ASSERT(shareIs(errors.falseShadow, falseShadow));
  RC_ASSERT(shareIs(errors.falseLit, falseLit));
  RC_ASSERT(shareIs(errors.misclassified, falseShadow + falseLit));
  RC_ASSERT(shareIs(errors.acne, acne));
  RC_ASSERT(shareIs(errors.leak, leak));
  RC_ASSERT(shareIs(errors.edge, falseShadow + falseLit - acne - leak));
  RC_ASSERT(shareIs(errors.interior, interior));
  RC_ASSERT(shareIs(errors.meanAbsolute, absolute));
  RC_ASSERT(std::abs(errors.rms - (receivers == 0 ? 0.0 : std::sqrt(squared / receivers))) < 1e-12);

  const bool some = !displacements.empty() && std::isfinite(displacements[0]);
  RC_ASSERT(errors.edgeDisplacement.has_value() == some);
  if (!some) return;
  std::sort(displacements.begin(), displacements.end());
  const auto rank = [&](double share) {
    return static_cast<float>(
        displacements[static_cast<std::size_t>(std::ceil(share * static_cast<double>(displacements.size())) - 1)]);
  };
  RC_ASSERT(errors.edgeDisplacement->median == rank(0.5));
  RC_ASSERT(errors.edgeDisplacement->p95 == rank(0.95));
  RC_ASSERT(errors.edgeDisplacement->max == rank(1.0));
  RC_ASSERT(std::isfinite(errors.edgeDisplacement->mean));
}

RC_GTEST_PROP(ErrorProperties, H1_SwappingShadowAndTruthSwapsTheirErrors, ()) {
  const RandomTruth random = randomTruth();
  Reference swapped = random.truth;
  swapped.lights[0].visibility = random.shown;
  const ErrorMetrics errors = measureErrors(random.truth, std::span(&random.shown, 1));
  const ErrorMetrics other = measureErrors(swapped, std::span(&random.truth.lights[0].visibility, 1));
  RC_ASSERT(errors.falseShadow == other.falseLit);
  RC_ASSERT(errors.falseLit == other.falseShadow);
  RC_ASSERT(errors.misclassified == other.misclassified);
  RC_ASSERT(errors.meanAbsolute == other.meanAbsolute);
  RC_ASSERT(errors.rms == other.rms);
}

} // namespace
} // namespace gnomon
