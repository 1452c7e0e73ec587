#include "renderer/scene/animation/samplers.h"

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>
#include <numbers>

#include "tests/renderer/scene/geometry.h"

namespace gnomon {
namespace {

Sampler threeComponents(Interpolation interpolation, std::vector<float> times, std::vector<float> values) {
  return {interpolation, 3, false, std::move(times), std::move(values)};
}

glm::dvec3 at(const Sampler& sampler, double time) {
  double value[3] = {};
  sample(sampler, time, value);
  return {value[0], value[1], value[2]};
}

glm::dquat rotationAt(const Sampler& sampler, double time) {
  double value[4] = {};
  sample(sampler, time, value);
  return {value[3], value[0], value[1], value[2]};
}

/// x y z w of a turn around Z.
std::vector<float> turn(double degrees) {
  const double half = degrees * std::numbers::pi / 360;
  return {0, 0, static_cast<float>(std::sin(half)), static_cast<float>(std::cos(half))};
}

Sampler turns(std::vector<std::vector<float>> keyframes) {
  Sampler sampler{Interpolation::linear, 4, true, {}, {}};
  for (const auto& keyframe : keyframes) {
    sampler.times.push_back(static_cast<float>(sampler.times.size()));
    sampler.values.insert(sampler.values.end(), keyframe.begin(), keyframe.end());
  }
  return sampler;
}

TEST(Sampling, LinearValuesGoStraight) {
  const Sampler sampler = threeComponents(Interpolation::linear, {1, 3, 4}, {0, 0, 0, 4, -2, 8, 0, 0, 1});
  expectNear(at(sampler, 1.5), {1, -0.5, 2});
  expectNear(at(sampler, 3), {4, -2, 8});
  expectNear(at(sampler, 3.25), {3, -1.5, 6.25});
}

TEST(Sampling, StepsHoldUntilTheNextKeyframe) {
  const Sampler sampler = threeComponents(Interpolation::step, {1, 3}, {1, 2, 3, 4, 5, 6});
  expectNear(at(sampler, 2.999), {1, 2, 3});
  expectNear(at(sampler, 3), {4, 5, 6});
}

TEST(Sampling, NothingMovesBeforeTheFirstAndAfterTheLastKeyframe) {
  for (const Interpolation interpolation : {Interpolation::linear, Interpolation::step}) {
    const Sampler sampler = threeComponents(interpolation, {1, 3}, {1, 2, 3, 4, 5, 6});
    for (const double time : {-1e9, 0.0, 0.999, 1.0}) expectNear(at(sampler, time), {1, 2, 3});
    for (const double time : {3.0, 3.001, 1e9}) expectNear(at(sampler, time), {4, 5, 6});
  }
  const Sampler spline =
      threeComponents(Interpolation::cubicSpline, {1, 3}, {9, 9, 9, 1, 2, 3, 9, 9, 9, 9, 9, 9, 4, 5, 6, 9, 9, 9});
  expectNear(at(spline, 0), {1, 2, 3});
  expectNear(at(spline, 5), {4, 5, 6});
}

TEST(Sampling, OneKeyframeIsAStill) {
  const Sampler sampler = threeComponents(Interpolation::linear, {2}, {1, 2, 3});
  for (const double time : {0.0, 2.0, 5.0}) expectNear(at(sampler, time), {1, 2, 3});
}

/// A cubic polynomial is its own spline, tangents being its derivative: x = s^3 - 2 s, y = s^2, z = 5.
TEST(Sampling, CubicSplinesFollowTheirTangents) {
  std::vector<float> values;
  const std::vector<float> times{0.5f, 1.5f, 4};
  for (const float s : times) {
    const std::vector<float> tangent{3 * s * s - 2, 2 * s, 0};
    values.insert(values.end(), tangent.begin(), tangent.end());
    values.insert(values.end(), {s * s * s - 2 * s, s * s, 5});
    values.insert(values.end(), tangent.begin(), tangent.end());
  }
  const Sampler sampler = threeComponents(Interpolation::cubicSpline, times, values);
  for (const double s : {0.5, 0.75, 1.25, 1.5, 2.0, 3.875}) {
    expectNear(at(sampler, s), {s * s * s - 2 * s, s * s, 5}, 1e-5);
  }
}

TEST(Sampling, RotationsTurnEvenlyTheShorterWay) {
  std::vector<float> other = turn(120);
  for (float& component : other) component = -component; // the same rotation
  const Sampler sampler = turns({turn(0), other});
  for (const double share : {0.1, 0.25, 0.5, 0.9}) {
    const glm::dvec3 x = rotationAt(sampler, share) * glm::dvec3(1, 0, 0);
    const double angle = 120 * share * std::numbers::pi / 180;
    expectNear(x, {std::cos(angle), std::sin(angle), 0}, 1e-6);
    EXPECT_NEAR(glm::length(rotationAt(sampler, share)), 1, 1e-6);
  }
}

TEST(Sampling, EqualAndOppositeRotationsGiveNumbers) {
  for (const auto& sampler : {turns({turn(30), turn(30)}), turns({turn(0), turn(360)}), turns({turn(0), turn(180)}),
                              turns({{1, 0, 0, 0}, {-1, 0, 0, 0}})}) {
    for (const double time : {0.0, 0.3, 0.5, 0.7, 1.0}) EXPECT_NEAR(glm::length(rotationAt(sampler, time)), 1, 1e-6);
  }
}

TEST(Sampling, ASplineOfRotationsStaysOne) {
  Sampler sampler = turns({{0, 0, 0, 0}, turn(0), {0, 0, 2, 0}, {0, 0, 0, 0}, turn(90), {0, 0, 0, 0}});
  sampler.interpolation = Interpolation::cubicSpline;
  sampler.times = {0, 1};
  const double t = 0.25;
  const double z = t * t * t - 2 * t * t + t;
  const std::vector<float> to = turn(90);
  const double share = 3 * t * t - 2 * t * t * t;
  const glm::dquat expected =
      glm::normalize(glm::dquat((1 - share) + share * double{to[3]}, 0, 0, 2 * z + share * double{to[2]}));
  const glm::dquat actual = rotationAt(sampler, t);
  EXPECT_NEAR(actual.z, expected.z, 1e-6);
  EXPECT_NEAR(actual.w, expected.w, 1e-6);
  // Through zero: the nearer keyframe stands in.
  Sampler crossing = turns({{0, 0, 0, 0}, {0, 0, 0, 1}, {0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, -1}, {0, 0, 0, 0}});
  crossing.interpolation = Interpolation::cubicSpline;
  crossing.times = {0, 1};
  EXPECT_NEAR(glm::length(rotationAt(crossing, 0.5)), 1, 1e-12);
}

} // namespace
} // namespace gnomon
