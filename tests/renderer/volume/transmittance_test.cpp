#include "renderer/volume/transmittance.h"

#include <cmath>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "renderer/volume/extinction_cells.h"
#include "renderer/volume/volume_picture.h"
#include "tests/renderer/volume/media.h"

namespace gnomon {
namespace {

EndlessRays raysOf(const std::vector<Ray>& all, const glm::dvec3& origin) {
  EndlessRays rays{};
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      rays.from[axis][i] = all[i].origin[axis] - origin[axis];
      rays.toward[axis][i] = static_cast<float>(all[i].direction[axis]);
    }
    rays.asked[i] = -1;
  }
  return rays;
}

double throughOne(std::span<const Medium* const> media, const Ray& ray, const glm::dvec3& origin = glm::dvec3(0)) {
  return double{Transmittance(media, origin).along(raysOf({ray}, origin))[0]};
}

/// Beyond the ray's origin.
double lengthIn(const VolumeSpace& space, const Ray& ray) {
  const auto inside = insideUnitCube(toUnit(space, ray));
  return inside ? std::max(inside->to, 0.0) - std::max(inside->from, 0.0) : 0.0;
}

TEST(Transmittance, AHomogeneousBoxIsExactAtAnyResolution) {
  EXPECT_TRUE(rc::check([](unsigned seed) {
    Chances chances(seed);
    const glm::dvec3 middle = chances.below(2) * 1e6 * chances.direction();
    const VolumeSpace space = anySpace(chances, middle);
    const glm::ivec3 voxels(1 + chances.below(50), 1 + chances.below(50), 1 + chances.below(50));
    const double sigma = std::pow(10, chances.between(-4, 1));
    const Ray ray{toWorld(space, 3.0 * chances.place() - 1.0), chances.direction()};
    const Medium medium = homogeneous(space, sigma, voxels);
    const Medium* media[]{&medium};
    const double depth = sigma * lengthIn(space, ray);
    RC_ASSERT(std::abs(throughOne(media, ray, middle + chances.direction()) - std::exp(-depth)) < 1e-5 + 1e-4 * sigma);
  }));
}

TEST(Transmittance, RaysAlongAnAxisAndOnAFaceAreExact) {
  const Medium medium = homogeneous(boxSpace({0, 0, 0}, {2, 4, 6}), 0.5);
  const Medium* media[]{&medium};
  EXPECT_NEAR(throughOne(media, {{1, -3, 3}, {0, 1, 0}}), std::exp(-2.0), 1e-6);
  EXPECT_NEAR(throughOne(media, {{1, 0, 3}, {0, 1, 0}}), std::exp(-2.0), 1e-6) << "from its face";
  EXPECT_NEAR(throughOne(media, {{1, 3, 3}, {0, 1, 0}}), std::exp(-0.5), 1e-6) << "from inside";
  EXPECT_EQ(throughOne(media, {{1, 5, 3}, {0, 1, 0}}), 1) << "it lies behind";
  EXPECT_EQ(throughOne(media, {{3, -1, 3}, {0, 1, 0}}), 1) << "it lies beside";
}

TEST(Transmittance, ACloudIsCloseToItsOwnVoxels) {
  const VolumeSpace space = turnedSpace({3, 2, 1}, {4, 5, 6}, 0.7, glm::normalize(glm::dvec3(1, 2, 3)));
  for (const int side : {8, 24, 48, 128}) {
    const Medium medium = ball(space, 1.5, side);
    const Medium* media[]{&medium};
    Chances chances(7);
    double sum = 0;
    for (int i = 0; i < 500; ++i) {
      const Ray ray{toWorld(space, 2.0 * chances.place() - 0.5), chances.direction()};
      const double wanted = std::exp(-opticalDepth(media, ray, {0, kInfinite}));
      const double off = std::abs(throughOne(media, ray) - wanted);
      EXPECT_LT(off, 0.01) << side;
      sum += off;
    }
    EXPECT_LT(sum / 500, 0.001) << side;
  }
}

TEST(Transmittance, SeveralMultiplyAndWhatCastsNothingIsNotThere) {
  const Medium one = homogeneous(boxSpace({0, 0, 0}, {1, 1, 1}), 0.7);
  const Medium two = homogeneous(boxSpace({0, 0.5, 0}, {1, 2.5, 1}), 0.2);
  Medium shadowless = homogeneous(boxSpace({0, 0, 0}, {1, 9, 1}), 3);
  shadowless.castShadow = false;
  const Medium empty = homogeneous(boxSpace({0, 0, 0}, {1, 9, 1}), 0);
  const Medium* media[]{&one, &two, &shadowless, &empty};
  EXPECT_NEAR(throughOne(media, {{0.5, -1, 0.5}, {0, 1, 0}}), std::exp(-0.7 - 0.4), 1e-6);
  EXPECT_FALSE(Transmittance(media, {}).empty());
  EXPECT_TRUE(Transmittance(std::span(media).subspan(2), {}).empty());
}

TEST(Transmittance, LanesDoNotKnowOfEachOther) {
  const VolumeSpace space = boxSpace({-1, -1, -1}, {1, 1, 1});
  const Medium medium = ball(space, 2, 40);
  const Medium* media[]{&medium};
  const Transmittance transmittance(media, {});
  Chances chances(3);
  std::vector<Ray> all;
  for (std::size_t i = 0; i < EndlessRays::kCount; ++i) {
    all.push_back({4.0 * chances.place() - 2.0, chances.direction()});
  }
  EndlessRays rays = raysOf(all, {});
  const auto together = transmittance.along(rays);
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(transmittance.along(raysOf({all[i]}, {}))[0], together[i]) << i;
    EXPECT_EQ(transmittance.along(raysOf({all[i]}, {}))[1], 1) << "a lane that holds no ray";
  }
  for (std::size_t i = 0; i < all.size(); i += 2) {
    rays.asked[i] = 0;
    rays.from[0][i] = std::nan("");
    rays.toward[1][i] = std::nanf("");
  }
  const auto half = transmittance.along(rays);
  for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(half[i], i % 2 == 0 ? 1 : together[i]) << i;
}

TEST(ExtinctionCells, AreBoundedByWhatIsThere) {
  const auto grid = gridOf({64, 64, 64}, [](const glm::dvec3& at) { return at.x > 0.5 && at.y < 0.25 ? 1.0 : 0.0; });
  const Medium medium = makeMedium(grid, proportional(2), boxSpace({0, 0, 0}, {1, 1, 1}));
  const ExtinctionCells& cells = *medium.cells;
  EXPECT_EQ(cells.size, glm::ivec3(32));
  EXPECT_EQ(cells.perMetre.size(), 34u * 34u * 34u);
  EXPECT_NEAR(cells.low.x, 0.5 - 0.5 / 32, 1e-6);
  EXPECT_EQ(cells.low.y, 0);
  EXPECT_EQ(cells.high.x, 1);
  EXPECT_NEAR(cells.high.y, 0.25 + 0.5 / 32, 1e-6);
}

} // namespace
} // namespace gnomon
