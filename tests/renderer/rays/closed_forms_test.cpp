#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "tests/renderer/rays/shapes.h"

namespace gnomon {
namespace {

using testing::addQuad;
using testing::addSphere;
using testing::addSquare;
using testing::GlbBuilder;
using testing::parallelView;
using testing::sunAlong;
using testing::Traced;

/// Share of a disc's area on the side x > `at` of a line; `at` in radii from the middle.
double segmentShare(double at) {
  const double x = std::clamp(at, -1.0, 1.0);
  return (std::acos(x) - x * std::sqrt(1 - x * x)) / glm::pi<double>();
}

/// Share of the disc of `radius` around `center` that lies in the square |x|, |z| <= half, by Simpson's rule.
double shareInSquare(const glm::dvec2& center, double radius, double half) {
  const double low = std::max(center.x - radius, -half);
  const double high = std::min(center.x + radius, half);
  if (low >= high) return 0;
  const auto chord = [&](double x) {
    const double reach = std::sqrt(std::max(0.0, radius * radius - (x - center.x) * (x - center.x)));
    return std::max(0.0, std::min(center.y + reach, half) - std::max(center.y - reach, -half));
  };
  constexpr int kSteps = 4000;
  double sum = chord(low) + chord(high);
  for (int i = 1; i < kSteps; ++i) sum += (i % 2 == 1 ? 4 : 2) * chord(low + (high - low) * i / kSteps);
  return sum * (high - low) / (3 * kSteps) / (glm::pi<double>() * radius * radius);
}

/// A square of half 2 m at height 3 over a floor of half 10 m, the floor seen from above as if the square were glass.
Traced twoSquares() {
  GlbBuilder builder;
  addSquare(builder, 10, 0);
  addSquare(builder, 2, 3);
  Traced traced(builder);
  traced.nodes = {{}, {false, true, true, 1}};
  traced.camera = parallelView({0.01, 8, 0.02}, {0, -1, 0}, 8);
  return traced;
}

struct Errors {
  double largest = 0;
  double mean = 0;
};

/// Of the visibility against `truth(place)`, relative to the scene.
template <class Truth>
Errors errorsOf(const Traced& traced, int samples, Truth truth) {
  const std::vector<SurfacePoint> points = traced.surface();
  const std::vector<float> visibility = lightVisibility(traced.input(), 0, points, samples);
  Errors errors;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double error = std::abs(visibility[i] - truth(points[i].position + traced.anchor()));
    errors.largest = std::max(errors.largest, error);
    errors.mean += error / static_cast<double>(points.size());
  }
  return errors;
}

TEST(ClosedForms, N1_ASpheresShadowOnAPlaneIsAnEllipse) {
  constexpr int kCells = 400; // its silhouette lies between the sphere and 3.1e-5 radii less
  const glm::dvec3 center(0.3, 2.0, -0.4);
  GlbBuilder builder;
  addSquare(builder, 8, 0);
  addSphere(builder, center, 1.0, kCells);
  Traced traced(builder);
  traced.nodes = {{}, {false, true, true, 1}};
  traced.width = traced.height = 300;
  traced.camera = parallelView({0, 6, 0}, {0, -1, 0}, 9);
  for (const glm::dvec3& light : {glm::dvec3(0, -1, 0), glm::dvec3(0.8, -1, 0.3), glm::dvec3(-1, -1, 1)}) {
    traced.lights = {sunAlong(light)};
    const std::vector<SurfacePoint> points = traced.surface();
    const std::vector<float> visibility = lightVisibility(traced.input(), 0, points, 1);
    int shadowed = 0;
    int wrong = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const glm::dvec3 away = points[i].position + traced.anchor() - center;
      const double fromAxis = glm::length(glm::cross(away, glm::normalize(light)));
      shadowed += visibility[i] < 0.5f ? 1 : 0;
      if (fromAxis > 1 + 1e-6) wrong += visibility[i] == 1 ? 0 : 1;
      if (fromAxis < 1 - 6e-5) wrong += visibility[i] == 0 ? 0 : 1;
    }
    EXPECT_EQ(wrong, 0);
    EXPECT_GT(shadowed, 2000);
  }
}

TEST(ClosedForms, AStraightEdgeUnderTheSunsDiscCutsASegmentOff) {
  GlbBuilder builder;
  addSquare(builder, 50, 0);
  addQuad(builder, {{-50, 4, 50}, {0, 4, 50}, {0, 4, -50}, {-50, 4, -50}});
  Traced traced(builder);
  traced.nodes = {{}, {false, true, true, 1}};
  traced.camera = parallelView({0, 8, 0}, {0, -1, 0}, 1);
  for (const int samples : {64, 256, 1024}) {
    traced.lights = {sunAlong({0, -1, 0}, 10)};
    const double radius = 4 * std::tan(glm::radians(5.0));
    const Errors errors = errorsOf(traced, samples, [&](const glm::dvec3& p) { return segmentShare(-p.x / radius); });
    // Random rays would be off by 0.4 / sqrt(samples) in the mean.
    EXPECT_LT(errors.mean, 1.0 / samples) << samples;
    EXPECT_LT(errors.largest, 6.0 / samples) << samples;
  }
}

TEST(ClosedForms, TwoParallelSquaresUnderTheSunsDisc) {
  Traced traced = twoSquares();
  for (const double degrees : {0.53, 5.0, 40.0, 90.0}) {
    traced.lights = {sunAlong({0, -1, 0}, degrees)};
    const double radius = 3 * std::tan(glm::radians(0.5 * degrees));
    const Errors errors = errorsOf(traced, 256, [&](const glm::dvec3& p) {
      return 1 - shareInSquare({p.x, p.z}, radius, 2);
    });
    EXPECT_LT(errors.mean, 1.0 / 256) << degrees;
    EXPECT_LT(errors.largest, 10.0 / 256) << degrees;
  }
}

TEST(ClosedForms, TwoParallelSquaresUnderALampsDisc) {
  // The disc faces each point, so an edge along z cuts it along a line; where it does is plane geometry.
  GlbBuilder builder;
  addSquare(builder, 50, 0);
  addQuad(builder, {{-500, 3, 500}, {0.5, 3, 500}, {0.5, 3, -500}, {-500, 3, -500}});
  Traced traced(builder);
  traced.nodes = {{}, {false, true, true, 1}};
  traced.height = 1;
  traced.camera = parallelView({0.6, 8, 0}, {0, -1, 0}, 3);
  traced.camera.halfSize = {1.5, 1e-6};
  constexpr double kRadius = 0.8;
  const glm::dvec2 lamp(0, 7);
  traced.lights = {testing::pointAt({lamp.x, lamp.y, 0}, kRadius)};
  const Errors errors = errorsOf(traced, 1024, [&](const glm::dvec3& p) {
    const glm::dvec2 toLamp = lamp - glm::dvec2(p.x, p.y);
    const glm::dvec2 toEdge = glm::dvec2(0.5, 3) - glm::dvec2(p.x, p.y);
    const glm::dvec2 across = glm::normalize(glm::dvec2(toLamp.y, -toLamp.x)); // towards +x
    const double at = glm::dot(toEdge, across) * glm::dot(toLamp, toLamp) / glm::dot(toEdge, toLamp);
    return segmentShare(at / kRadius);
  });
  EXPECT_LT(errors.mean, 1.0 / 1024);
  EXPECT_LT(errors.largest, 4.0 / 1024);
}

/// Where along x, from `low` to `high`, the share passes `share`; the visibility grows with x.
double whereVisible(Traced& traced, double low, double high, float share) {
  traced.width = traced.height = 1;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    traced.camera = parallelView({middle, 2, 0}, {0, -1, 0}, 1e-6);
    (lightVisibility(traced.input(), 0, traced.surface(), 4096)[0] > share ? high : low) = middle;
  }
  return low;
}

TEST(ClosedForms, N1_ThePenumbraIsAsWideAsTheLightsSizeMakesIt) {
  // w = size (d_recv - d_occ) / d_occ; the lamp stands over the edge, 10 m over the floor.
  GlbBuilder builder;
  addSquare(builder, 50, 0);
  addQuad(builder, {{-50, 4, 50}, {0, 4, 50}, {0, 4, -50}, {-50, 4, -50}});
  Traced traced(builder);
  for (const double radius : {0.05, 0.5}) {
    traced.lights = {testing::pointAt({0, 10, 0}, radius)};
    const double width = whereVisible(traced, -1, 1, 1 - 1e-3f) - whereVisible(traced, -1, 1, 1e-3f);
    const double expected = 2 * radius * (10.0 - 6.0) / 6.0;
    EXPECT_NEAR(width / expected, 1, 0.03) << radius;
  }
  for (const double degrees : {0.53, 10.0}) {
    traced.lights = {sunAlong({0, -1, 0}, degrees)};
    const double width = whereVisible(traced, -1, 1, 1 - 1e-3f) - whereVisible(traced, -1, 1, 1e-3f);
    EXPECT_NEAR(width / (2 * 4 * std::tan(glm::radians(0.5 * degrees))), 1, 0.03) << degrees;
  }
}

} // namespace
} // namespace gnomon
