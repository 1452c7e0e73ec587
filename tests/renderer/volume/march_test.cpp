#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <rapidcheck.h>

#include "renderer/volume/volume_picture.h"
#include "renderer/volume/volume_space.h"
#include "tests/renderer/volume/media.h"

namespace gnomon {
namespace {

constexpr Interval kAhead{0, kInfinite};

glm::dvec3 white(std::size_t, const glm::dvec3&) {
  return glm::dvec3(1);
}

Marched through(const Medium& medium, const Ray& ray, const Interval& piece = kAhead, double stepVoxels = kStepVoxels) {
  const Medium* media[]{&medium};
  return march(media, ray, piece, white, stepVoxels);
}

/// The length of what two intervals share.
double shared(const std::optional<Interval>& line, const Interval& piece) {
  return line ? std::max(0.0, std::min(line->to, piece.to) - std::max(line->from, piece.from)) : 0.0;
}

TEST(March, D7_AHomogeneousSlabTakesOneLessExpOfSigmaLAtAnyStepAndResolution) {
  EXPECT_TRUE(rc::check([](unsigned seed) {
    Chances chances(seed);
    const glm::dvec3 middle = chances.below(2) * 1e6 * chances.direction();
    const VolumeSpace space = anySpace(chances, middle);
    const glm::ivec3 voxels(1 + chances.below(20), 1 + chances.below(20), 1 + chances.below(20));
    const double sigma = std::pow(10, chances.between(-4, 1));
    const Ray ray{toWorld(space, 3.0 * chances.place() - 1.0), chances.direction()};
    const Interval piece{chances.between(-10, 5), chances.between(5, 40)};
    const double length = shared(insideUnitCube(toUnit(space, ray)), piece);
    const Medium medium = homogeneous(space, sigma, voxels);
    for (const double step : {0.05, 0.5, 3.0, 1000.0}) {
      const Marched marched = through(medium, ray, piece, step);
      const double taken = -std::expm1(-sigma * length);
      RC_ASSERT(std::abs(1 - marched.transmittance - taken) < 2e-5);
      RC_ASSERT(std::abs(marched.color.x - 0.5 * taken) < 2e-5);
      const Medium* media[]{&medium};
      RC_ASSERT(std::abs(opticalDepth(media, ray, piece, step) - sigma * length) < 1e-9 * (1 + sigma * length));
    }
  }));
}

TEST(March, D7_StepAndResolutionHardlyChangeASmoothCloud) {
  const VolumeSpace space = boxSpace({0, 0, 0}, {4, 4, 4});
  const Ray ray{{-1, 1.7, 2.2}, {1, 0, 0}};
  const double wanted = through(ball(space, 1.5, 128), ray, kAhead, 0.1).transmittance;
  EXPECT_LT(wanted, 0.2);
  EXPECT_GT(wanted, 0.02);
  for (const int side : {24, 48, 96}) {
    for (const double step : {0.1, 0.5, 1.0}) {
      EXPECT_NEAR(through(ball(space, 1.5, side), ray, kAhead, step).transmittance, wanted, 0.002)
          << side << ' ' << step;
    }
  }
}

TEST(March, OverlappingVolumesAreTheirSum) {
  EXPECT_TRUE(rc::check([](unsigned seed) {
    Chances chances(seed);
    const auto space = [&] {
      return turnedSpace(4.0 * chances.place(), 0.5 + 4.0 * chances.place(), chances.between(0, 7),
                         chances.direction());
    };
    std::vector<Medium> media;
    for (int i = 0; i < 3; ++i) media.push_back(homogeneous(space(), chances.between(0, 1)));
    media.push_back(ball(space(), chances.between(0, 1), 24));
    const Ray ray{4.0 * chances.place(), chances.direction()};
    std::vector<const Medium*> all;
    double depth = 0;
    for (const Medium& medium : media) {
      const Medium* alone[]{&medium};
      depth += opticalDepth(alone, ray, {-10, 10});
      all.push_back(&medium);
    }
    const Marched marched = march(all, ray, {-10, 10}, white);
    RC_ASSERT(std::abs(opticalDepth(all, ray, {-10, 10}) - depth) < 2e-3);
    RC_ASSERT(std::abs(marched.transmittance - std::exp(-depth)) < 2e-3);
    std::swap(all[0], all[3]);
    const Marched swapped = march(all, ray, {-10, 10}, white);
    RC_ASSERT(std::abs(swapped.transmittance - marched.transmittance) < 1e-12);
    RC_ASSERT(std::abs(swapped.color.x - marched.color.x) < 1e-12);
  }));
}

TEST(March, WhereVolumesOverlapEachScattersItsShare) {
  const VolumeSpace space = boxSpace({0, 0, 0}, {1, 1, 1});
  const Medium thin = homogeneous(space, 1), dense = homogeneous(space, 3);
  const Medium* media[]{&thin, &dense};
  const auto byIndex = [](std::size_t medium, const glm::dvec3&) {
    return medium == 0 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  };
  const Marched marched = march(media, {{0.5, 0.5, -1}, {0, 0, 1}}, kAhead, byIndex);
  const double scattered = 0.5 * -std::expm1(-4.0);
  EXPECT_NEAR(marched.color.x, scattered / 4, 1e-9);
  EXPECT_NEAR(marched.color.y, scattered * 3 / 4, 1e-9);
}

TEST(March, TheNearVolumeHidesTheFarOneWhateverTheirOrder) {
  const Medium near = homogeneous(boxSpace({0, 0, 1}, {1, 1, 2}), 20),
               far = homogeneous(boxSpace({0, 0, 5}, {1, 1, 6}), 20);
  const auto nearIsRed = [](bool nearFirst) {
    return [nearFirst](std::size_t medium, const glm::dvec3&) {
      return (medium == 0) == nearFirst ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1);
    };
  };
  const Ray ray{{0.5, 0.5, 0}, {0, 0, 1}};
  const Medium* forwards[]{&near, &far};
  const Medium* backwards[]{&far, &near};
  for (const Marched& marched :
       {march(forwards, ray, kAhead, nearIsRed(true)), march(backwards, ray, kAhead, nearIsRed(false))}) {
    EXPECT_NEAR(marched.color.x, 0.5, 1e-4);
    EXPECT_EQ(marched.color.z, 0);
    EXPECT_EQ(marched.transmittance, 0);
  }
}

TEST(March, D7_SurfacesTheNearPlaneAndACameraInsideCutIt) {
  const Medium medium = homogeneous(boxSpace({-5, -5, -10}, {5, 5, 10}), 0.1);
  CameraView view;
  view.near = 1;
  view.far = 6;
  const auto share = [&](const glm::dvec2& ndc, double surfaceDepth) {
    const ViewRay ray = viewRayAt(view, ndc);
    const Interval piece{ray.seen.from, std::min(ray.seen.to, surfaceDepth * ray.metresPerDepth)};
    return std::pair(through(medium, ray.ray, piece).transmittance, ray.metresPerDepth);
  };
  EXPECT_NEAR(share({0, 0}, 100).first, std::exp(-0.1 * 5), 1e-9);
  EXPECT_NEAR(share({0, 0}, 3).first, std::exp(-0.1 * 2), 1e-9);
  EXPECT_EQ(share({0, 0}, 0.5).first, 1);
  const auto [corner, longer] = share({0.5, 0.5}, 4);
  EXPECT_NEAR(corner, std::exp(-0.1 * 3 * longer), 1e-9);
  view.perspective = false;
  view.near = -20;
  view.far = 30;
  EXPECT_NEAR(share({0.9, 0.9}, 100).first, std::exp(-0.1 * 20), 1e-9);
  EXPECT_NEAR(share({0.9, 0.9}, -4).first, std::exp(-0.1 * 6), 1e-9);
}

TEST(March, EmptySpaceIsSkippedAndNothingInItIsMissed) {
  // One voxel among nothing, at the borders of bricks and of the grid.
  for (const glm::ivec3& filled : {glm::ivec3(8, 8, 8), glm::ivec3(7, 15, 16), glm::ivec3(31, 0, 23)}) {
    const auto grid =
        gridOf(glm::ivec3(32), [&](const glm::dvec3& unit) { return glm::ivec3(unit * 32.0) == filled ? 1.0 : 0.0; });
    const Medium medium = makeMedium(grid, proportional(1), boxSpace({0, 0, 0}, {32, 32, 32}));
    Medium unskipped = medium;
    std::fill(unskipped.bricks.filled.begin(), unskipped.bricks.filled.end(), std::uint8_t{1});
    const Medium* skipping[]{&medium};
    const Medium* whole[]{&unskipped};
    const glm::dvec3 target = glm::dvec3(filled) + 0.5;
    for (const glm::dvec3& from : {glm::dvec3(-10, 3, 5), glm::dvec3(40, 35, 50), glm::dvec3(16, 16, -5)}) {
      for (const double aside : {0.0, 0.4, -0.9}) {
        const Ray ray{from, glm::normalize(target + aside - from)};
        const double depth = opticalDepth(whole, ray, kAhead, 0.02);
        EXPECT_TRUE(depth > 0 || aside != 0);
        EXPECT_NEAR(opticalDepth(skipping, ray, kAhead, 0.02), depth, 2e-4);
      }
    }
    EXPECT_EQ(opticalDepth(skipping, {{-1, 28, 4}, {1, 0, 0}}, kAhead), 0);
  }
}

TEST(March, ItEndsHoweverFarAwayTheVolumeIs) {
  const double far = 1e14; // a double has steps of a 64th of a metre there
  const Medium medium = homogeneous(boxSpace({far, -1, -1}, {far + 2, 1, 1}), 1, {512, 1, 1});
  EXPECT_NEAR(through(medium, {{0, 0, 0}, {1, 0, 0}}).transmittance, std::exp(-2.0), 1e-6);
}

} // namespace
} // namespace gnomon
