#include "renderer/shadow/receiver_pieces.h"

#include <cmath>
#include <cstdio>
#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>

#include "tests/renderer/shadow/plan_lookup.h"

namespace gnomon {
namespace {

TEST(ReceiverPieces, X18_HoldsTheReceiversAndLittleElse) {
  EXPECT_TRUE(rc::check([](const RandomPlan& random) {
    const PlanInput& input = random.input;
    RC_PRE(!input.receivers.range.empty());
    const LightBasis basis = lightBasis(input.casters[0].direction);
    const double nearest = input.receivers.range.nearest;
    const double farthest = input.receivers.range.farthest;
    const Aabb box = boxAround(receiverPieces(input.view, input.receivers, basis, {nearest, farthest, farthest}));

    Aabb corners; // the corners of every block's piece of view, two pixels wider
    const ReceiverDepths& r = input.receivers;
    for (int i = 0; i < r.columns * r.rows; ++i) {
      const DepthSpan& span = r.blocks[static_cast<std::size_t>(i)];
      if (span.empty()) continue;
      const glm::dvec2 first(i % r.columns * 8 - 2, i / r.columns * 8 - 2);
      for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec2 pixel = first + glm::dvec2(corner & 1, corner >> 1 & 1) * 12.0;
        const glm::dvec2 ndc(2 * pixel.x / r.width - 1, 1 - 2 * pixel.y / r.height);
        const double depth = corner & 4 ? span.farthest : span.nearest;
        corners.add(basis.lightFromWorld() * pointAt(input.view, ndc, depth));
      }
    }
    Dice dice(random.seed + 4);
    for (int i = 0; i < 100; ++i) {
      const glm::dvec3 point = basis.lightFromWorld() * randomReceiver(dice, input).relative;
      for (int axis = 0; axis < 3; ++axis) RC_ASSERT(point[axis] >= box.min[axis] && point[axis] <= box.max[axis]);
    }
    const double slack = 1e-3 * glm::length(corners.max - corners.min) +
                         2 * depthSlack(input.view, std::max(std::abs(nearest), std::abs(farthest))) *
                             (1 + glm::length(input.view.halfSize));
    for (int axis = 0; axis < 3; ++axis) {
      RC_ASSERT(box.min[axis] >= corners.min[axis] - slack && box.max[axis] <= corners.max[axis] + slack);
    }
  }));
}

TEST(ReceiverPieces, X18_ACascadeWithoutSurfacesIsEmpty) {
  const PlanInput input = simplePlan(10, 20);
  const auto box = [&](const CascadeInterval& cascade) {
    return boxAround(receiverPieces(input.view, input.receivers, LightBasis{}, cascade));
  };
  EXPECT_TRUE(box({1, 5, 5}).empty());
  EXPECT_TRUE(box({30, 40, 40}).empty());
  const Aabb middle = box({5, 15, 15});
  // A basis that looks along -Z: light space x and y are the view's, and z is the depth.
  EXPECT_NEAR(middle.min.z, 10, 1e-3);
  EXPECT_NEAR(middle.max.z, 15, 1e-3);
  EXPECT_NEAR(middle.max.x, 15, 0.05);
}

double areaAround(const std::vector<glm::dvec2>& points, double angle) {
  const glm::dvec2 right(std::cos(angle), std::sin(angle));
  Aabb box;
  for (const glm::dvec2& p : points) {
    box.add(glm::dvec3(glm::dot(right, p), right.x * p.y - right.y * p.x, 0));
  }
  return (box.max.x - box.min.x) * (box.max.y - box.min.y);
}

TEST(TightRoll, M16_FindsTheTurnOfARectangleThatWasTurned) {
  for (double angle = -3; angle < 3; angle += 0.1) {
    std::vector<glm::dvec2> points;
    for (int i = 0; i <= 40; ++i) {
      for (int j = 0; j <= 4; ++j) {
        points.emplace_back(i * std::cos(angle) - j * std::sin(angle) + 100,
                            i * std::sin(angle) + j * std::cos(angle) - 7);
      }
    }
    EXPECT_NEAR(areaAround(points, rollOfLeastArea(points)), 160, 1e-9);
  }
}

TEST(TightRoll, M16_NoTurnIsMuchBetter) {
  EXPECT_TRUE(rc::check([](unsigned seed) {
    Dice dice(seed);
    std::vector<glm::dvec2> points;
    const double stretch = dice.between(0.2, 1);
    for (int i = 0; i < 200; ++i) points.emplace_back(dice.between(-1, 1), stretch * dice.between(-1, 1));
    const double found = areaAround(points, rollOfLeastArea(points));
    for (double angle = 0; angle < glm::half_pi<double>(); angle += 0.01) {
      RC_ASSERT(areaAround(points, angle) > 0.9 * found);
    }
  }));
}

TEST(TightRoll, M16_RoundingDoesNotChooseBetweenTurnsThatAreAsGood) {
  for (double angle = -3; angle < 3; angle += 0.1) {
    const auto found = [&](unsigned seed) {
      Dice dice(seed);
      std::vector<glm::dvec2> points;
      for (int i = 0; i <= 40; ++i) {
        for (int j = 0; j <= 20; ++j) {
          const glm::dvec2 at(i + dice.between(-1e-7, 1e-7), j + dice.between(-1e-7, 1e-7));
          points.emplace_back(at.x * std::cos(angle) - at.y * std::sin(angle),
                              at.x * std::sin(angle) + at.y * std::cos(angle));
        }
      }
      return rollOfLeastArea(points);
    };
    for (unsigned seed = 1; seed < 20; ++seed) EXPECT_NEAR(found(seed), found(0), 1e-5) << angle;
  }
}

TEST(TightRoll, PointsWithoutAnAreaGiveAFiniteTurn) {
  EXPECT_EQ(rollOfLeastArea({}), 0.0);
  const std::vector<glm::dvec2> same(5, glm::dvec2(3, 4));
  EXPECT_TRUE(std::isfinite(rollOfLeastArea(same)));
  const std::vector<glm::dvec2> line{{0, 0}, {1, 1}, {2, 2}};
  EXPECT_NEAR(areaAround(line, rollOfLeastArea(line)), 0, 1e-12);
}

TEST(TightRoll, M3_TurnsTheBasisAboutTheLightOnly) {
  EXPECT_TRUE(rc::check([](unsigned seed) {
    Dice dice(seed);
    const LightBasis basis = lightBasis(dice.direction());
    const LightBasis turned = rolled(basis, dice.between(-4, 4));
    RC_ASSERT(turned.direction == basis.direction);
    RC_ASSERT(glm::length(glm::cross(turned.right, turned.up) + turned.direction) < 1e-14);
    RC_ASSERT(std::abs(glm::dot(turned.right, turned.up)) < 1e-14);
  }));
}

TEST(TightRoll, M16_AGroundTakesMuchLessAreaThanWithAnArbitraryRoll) {
  PlanInput input = simplePlan(1, 1); // looks along -Z over a ground 2 m below the eye, out to 60 m
  ReceiverDepths& receivers = input.receivers;
  for (int row = 0; row < 80; ++row) {
    for (int column = 0; column < 80; ++column) {
      const auto depthAt = [](double pixel) { return 2.0 / (2.0 * pixel / 640 - 1.0); };
      DepthSpan& span = receivers.blocks[static_cast<std::size_t>(row * 80 + column)];
      span = row < 42 ? DepthSpan{}
                      : DepthSpan{static_cast<float>(depthAt(row * 8 + 8)), static_cast<float>(depthAt(row * 8))};
    }
  }
  receivers.range = {2.0f, 40.0f};
  const CascadeInterval far{15, 40, 40};
  double product = 1;
  const int suns = 24;
  for (int i = 0; i < suns; ++i) {
    const double azimuth = i * 2 * glm::pi<double>() / suns;
    const LightBasis basis = lightBasis(glm::normalize(glm::dvec3(std::sin(azimuth), -0.6, std::cos(azimuth))));
    const auto area = [&](const LightBasis& b) {
      const Aabb box = boxAround(receiverPieces(input.view, receivers, b, far));
      return (box.max.x - box.min.x) * (box.max.y - box.min.y);
    };
    product *= area(basis) / area(tightBasis(input.view, receivers, basis, far));
  }
  const double mean = std::pow(product, 1.0 / suns);
  std::printf("ground at 15..40 m: area of an arbitrary roll %.2f times the tight one's\n", mean);
  EXPECT_GT(mean, 1.3);
}

} // namespace
} // namespace gnomon
