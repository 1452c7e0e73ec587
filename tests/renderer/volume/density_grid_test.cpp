#include "renderer/volume/density_grid.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <rapidcheck.h>

namespace gnomon {
namespace {

/// A value that is linear in the place, at every centre.
DensityGrid linearGrid(const glm::ivec3& size, const glm::dvec3& slope) {
  DensityGrid grid{size, {}};
  for (int z = 0; z < size.z; ++z) {
    for (int y = 0; y < size.y; ++y) {
      for (int x = 0; x < size.x; ++x) {
        const glm::dvec3 centre = (glm::dvec3(x, y, z) + 0.5) / glm::dvec3(size);
        grid.values.push_back(static_cast<float>(glm::dot(slope, centre)));
      }
    }
  }
  return grid;
}

TEST(DensityGrid, ReadsWhatIsLinearAsItIsBetweenTheOutermostCentres) {
  EXPECT_TRUE(rc::check([]() {
    const auto side = rc::gen::inRange(1, 9);
    const glm::ivec3 size(*side, *side, *side);
    const auto share = rc::gen::map(rc::gen::inRange(0, 1001), [](int n) { return n / 1000.0; });
    const glm::dvec3 unit(*share, *share, *share);
    const glm::dvec3 slope(1, -2, 3);
    const glm::dvec3 half = 0.5 / glm::dvec3(size);
    const glm::dvec3 held = glm::clamp(unit, half, 1.0 - half);
    RC_ASSERT(std::abs(valueAt(linearGrid(size, slope), unit) - glm::dot(slope, held)) < 1e-6);
  }));
}

TEST(DensityGrid, PlacesOutsideAreBroughtToTheFace) {
  const DensityGrid grid = linearGrid({4, 3, 2}, {1, 1, 1});
  EXPECT_EQ(valueAt(grid, {-5, 0.5, 0.5}), valueAt(grid, {0, 0.5, 0.5}));
  EXPECT_EQ(valueAt(grid, {0.5, 1e9, 0.5}), valueAt(grid, {0.5, 1, 0.5}));
}

TEST(DensityGrid, SidesAndCountHaveLimits) {
  EXPECT_EQ(*voxelCount(1, 1, 1), 1u);
  EXPECT_EQ(*voxelCount(kMaxGridSide, 1, kMaxGridSide), 2048u * 2048);
  EXPECT_EQ(*voxelCount(512, 512, 512), 512u * 512 * 512);
  const auto wide = voxelCount(100000, 1, 1);
  ASSERT_FALSE(wide);
  EXPECT_EQ(wide.problems().front().code, ProblemCode::tooLarge);
  EXPECT_EQ(wide.problems().front().limit, "1..2048");
  EXPECT_EQ(wide.problems().front().actual, "100000 x 1 x 1");
  const auto many = voxelCount(2048, 2048, 33);
  ASSERT_FALSE(many);
  EXPECT_EQ(many.problems().front().limit, std::to_string(kMaxGridVoxels));
  EXPECT_FALSE(voxelCount(0, 1, 1));
  EXPECT_FALSE(voxelCount(1, -1, 1));
  EXPECT_FALSE(voxelCount(std::numeric_limits<std::int64_t>::max(), std::numeric_limits<std::int64_t>::max(), 2));
}

TEST(DensityGrid, AValueThatIsNotFiniteIsNamedByItsPlace) {
  DensityGrid grid = linearGrid({4, 3, 2}, {1, 1, 1});
  ASSERT_TRUE(requireFinite(grid));
  grid.values[(1 * 3 + 2) * 4 + 3] = std::numeric_limits<float>::quiet_NaN();
  const auto refused = requireFinite(grid);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.problems().front().detail, "The voxel at x 3, y 2, z 1 is no finite number.");
  EXPECT_EQ(refused.problems().front().actual, "NaN");
}

} // namespace
} // namespace gnomon
