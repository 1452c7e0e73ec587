#include "renderer/rays/crossings.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <rapidcheck.h>

namespace gnomon {
namespace {

/// The same for one line, with the library's functions, which pass over what is not a number.
void entered(const Aabb& box, double near, double far, const glm::dvec3& origin, const glm::dvec3& direction,
             double& from, double& to) {
  from = -HUGE_VAL;
  to = HUGE_VAL;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = (box.min[axis] - origin[axis]) / direction[axis];
    const double high = (box.max[axis] - origin[axis]) / direction[axis];
    from = std::fmax(from, std::fmin(low, high));
    to = std::fmin(to, std::fmax(low, high));
  }
  from = std::max(near, from);
  to = std::min(far, to);
}

TEST(Crossings, LinesEnterABoxAlsoAlongItsSides) {
  EXPECT_TRUE(rc::check([] {
    std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
    // Few values: lines lie in sides, run along axes, end where the near plane is.
    std::uniform_int_distribution<int> place(-2, 2);
    const auto any = [&] { return double(place(random)); };
    Aabb box;
    for (int i = 0; i < 2; ++i) box.add(glm::dvec3(any(), any(), any()));
    const double near = *rc::gen::element(0.0, 1.0, 0.1);
    const double far = *rc::gen::element(1.5, 3.0, HUGE_VAL);
    Lines lines;
    for (unsigned i = 0; i < kLanes; ++i) {
      do {
        for (int axis = 0; axis < 3; ++axis) lines.direction[axis][i] = any() * (i % 4 < 2 ? 1 : 0.3);
      } while (lines.direction[0][i] == 0 && lines.direction[1][i] == 0 && lines.direction[2][i] == 0);
      for (auto& axis : lines.origin) axis[i] = any() * (i % 2 == 0 ? 1 : 1.25);
    }
    Lines moved = lines;
    Stretches stretches;
    enter(box, near, far, moved, stretches);
    for (unsigned i = 0; i < kLanes; ++i) {
      const glm::dvec3 origin(lines.origin[0][i], lines.origin[1][i], lines.origin[2][i]);
      const glm::dvec3 direction(lines.direction[0][i], lines.direction[1][i], lines.direction[2][i]);
      double from = 0, to = 0;
      entered(box, near, far, origin, direction, from, to);
      RC_ASSERT((stretches.meets[i] != 0) == (from <= to));
      if (stretches.meets[i] == 0) continue;
      RC_ASSERT(stretches.length[i] == far - from);
      for (int axis = 0; axis < 3; ++axis) {
        RC_ASSERT(moved.origin[axis][i] == origin[axis] + direction[axis] * from);
      }
    }
  }));
}

TEST(Crossings, LinesAlongATrianglesPlaneCrossItWhereItIsSaid) {
  Lines lines{};
  Crossings found{};
  for (unsigned i = 0; i < kLanes; ++i) {
    lines.direction[0][i] = 1;
    lines.direction[1][i] = i % 2; // every other one crosses
    lines.origin[1][i] = -0.25;
    found.b[0][i] = 1;
    found.c[2][i] = -1; // in the plane of y = 0, facing up
    found.u[i] = 0.5;
    found.v[i] = 0.125;
  }
  cross(lines, 1, found);
  for (unsigned i = 0; i < kLanes; ++i) {
    EXPECT_EQ(found.u[i], i % 2 == 0 ? 0.5 : 0.25);
    EXPECT_EQ(found.v[i], i % 2 == 0 ? 0.125 : 0);
    EXPECT_EQ(found.facing[i] > 0, i % 2 == 1);
    EXPECT_EQ(found.normal[1][i], i % 2 == 0 ? 1 : -1);
  }
}

} // namespace
} // namespace gnomon
