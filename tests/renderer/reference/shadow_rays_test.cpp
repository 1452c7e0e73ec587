#include "renderer/reference/shadow_rays.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace {

/// From the floor at 10 m from the anchor, 45 degrees up, as far as `length`.
ShadowRay slanted(double length) {
  ShadowRay ray;
  ray.from.position = {10, 0, 0};
  ray.from.normal = {0, 1, 0};
  ray.from.largest = {10, 0, 10};
  ray.direction = glm::normalize(glm::dvec3(1, 1, 0));
  ray.length = length;
  return ray;
}

constexpr double kFar = std::numeric_limits<double>::infinity();

Triangle wallAt(double x, double height) {
  return {{x, -1, -5}, {x, height, 0}, {x, -1, 5}};
}

TEST(ShadowRays, MeetWhatStandsInTheirWay) {
  EXPECT_NEAR(meets(slanted(kFar), wallAt(12, 9)).value_or(-1), 2 * std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(meets(slanted(3), wallAt(12, 9)).value_or(-1), 2 * std::sqrt(2.0), 1e-12);
  EXPECT_FALSE(meets(slanted(2.8), wallAt(12, 9))) << "beyond the light";
  EXPECT_FALSE(meets(slanted(kFar), wallAt(9.999999, 9))) << "behind the start";
  EXPECT_TRUE(meets(slanted(kFar), wallAt(10.000001, 9)));
}

TEST(ShadowRays, PassWhatDoesNotRiseOverTheReceiversPlane) {
  EXPECT_FALSE(meets(slanted(kFar), wallAt(10, 0)));
  EXPECT_FALSE(meets(slanted(kFar), {{9, 0, -5}, {9, 0, 5}, {12, 0, 0}})) << "coplanar";
  // Heights are known to within the rounding of heights: those of a level floor are exact, however far it reaches.
  EXPECT_TRUE(meets(slanted(kFar), {{9, 1e-9, -5}, {9, 1e-9, 5}, {1e7, 2e-9, 0}}));
  ShadowRay raised = slanted(kFar);
  raised.from.position.y = raised.from.largest.y = 1;
  EXPECT_FALSE(meets(raised, {{9, 1 + 1e-7, -5}, {9, 1, 5}, {12, 1, 0}}));
  EXPECT_TRUE(meets(raised, {{9, 1 + 1e-6, -5}, {9, 1, 5}, {12, 1, 0}}));
}

TEST(ShadowRays, PassTrianglesAlongTheirWayOrWithoutAnArea) {
  EXPECT_FALSE(meets(slanted(kFar), {{11, 1, 0}, {12, 2, 0}, {12, 2, 0}}));
  EXPECT_FALSE(meets(slanted(kFar), {{11, 1, 0}, {12, 2, 0}, {13, 3, 0}}));
  EXPECT_FALSE(meets(slanted(kFar), {{11, 5, 1}, {11, 5, 1}, {11, 5, 1}}));
}

} // namespace
} // namespace gnomon
