#include "tests/bench/other_picture.h"

#include <gtest/gtest.h>

#include "tests/support/files.h"

namespace gnomon::bench {
namespace {

constexpr int kSide = 4;
constexpr double kFar = 10; ///< metres to the wall

/// A wall across the view, 10 m away, seen through a lens of 90 degrees; the first pixel misses it.
Reference wall(const CameraView& view) {
  Reference truth;
  truth.width = truth.height = kSide;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const glm::dvec2 ndc{(2 * x + 1) / double{kSide} - 1, 1 - (2 * y + 1) / double{kSide}};
      SurfacePoint point;
      point.position = view.eye + pointAt(view, ndc, kFar);
      point.normal = {0, 0, 1};
      point.instance = x == 0 && y == 0 ? kNoSurface : 0;
      truth.surface.push_back(point);
      truth.pixelWidth.push_back(static_cast<float>(2 * kFar / kSide));
    }
  }
  return truth;
}

std::vector<float> depths(float all) {
  std::vector<float> depth(kSide * kSide, all);
  depth.front() = 0;
  return depth;
}

const CameraView kView{.eye = {3, 4, 5}};

TEST(OtherPicture, TheSameSurfacesAgree) {
  const Alignment alignment = alignmentOf(wall(kView), kView, {}, depths(kFar));
  EXPECT_EQ(alignment.coverage, 0);
  EXPECT_EQ(alignment.surface, 0);
  EXPECT_NEAR(alignment.offset, 0, 1e-6);
  EXPECT_EQ(alignment.same, std::vector<std::uint8_t>(kSide * kSide, 1));
}

TEST(OtherPicture, APointOffTheSurfaceByMoreThanHalfAPixelIsAnotherSurface) {
  std::vector<float> depth = depths(kFar);
  depth[5] += 2.4f; // a pixel is 5 m wide there
  depth[6] += 2.6f;
  const Alignment alignment = alignmentOf(wall(kView), kView, {}, depth);
  EXPECT_EQ(alignment.surface, 1.0 / 16);
  EXPECT_EQ(alignment.same[5], 1);
  EXPECT_EQ(alignment.same[6], 0);
}

TEST(OtherPicture, ASurfaceInOneOfThemOnlyIsTold) {
  std::vector<float> depth(kSide * kSide, kFar);
  depth[7] = 0;
  const Alignment alignment = alignmentOf(wall(kView), kView, {}, depth);
  EXPECT_EQ(alignment.coverage, 2.0 / 16);
  EXPECT_EQ(alignment.same[0], 0);
  EXPECT_EQ(alignment.same[7], 0);
}

TEST(OtherPicture, AnotherAnchorOrCameraIsNoMatch) {
  EXPECT_GT(alignmentOf(wall(kView), kView, {0, 0, 20}, depths(kFar)).surface, 0.9);
  CameraView other = kView;
  other.eye.z += 4;
  EXPECT_GT(alignmentOf(wall(kView), other, {}, depths(kFar)).surface, 0.9);
}

TEST(OtherPicture, FilesHoldShadowAndDepthInTurnAndMustHaveThePicturesSize) {
  const std::filesystem::path file = std::filesystem::path(::testing::TempDir()) / "other_picture.f32";
  const std::vector<float> values{0.25f, 7, 1, 8};
  testing::writeFile(file, {reinterpret_cast<const std::uint8_t*>(values.data()), values.size() * sizeof(float)});
  const auto picture = readOtherPicture(file, 2);
  ASSERT_TRUE(picture);
  EXPECT_EQ(picture->shown, (std::vector<float>{0.25f, 1}));
  EXPECT_EQ(picture->depth, (std::vector<float>{7, 8}));
  EXPECT_FALSE(readOtherPicture(file, 3));
  EXPECT_FALSE(readOtherPicture(file.string() + ".none", 2));
  std::filesystem::remove(file);
}

} // namespace
} // namespace gnomon::bench
