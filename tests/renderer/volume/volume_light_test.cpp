#include "renderer/volume/volume_light.h"

#include <cmath>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "renderer/volume/volume_picture.h"
#include "tests/renderer/volume/media.h"

namespace gnomon {
namespace {

const glm::dvec3 kUp(0, 1, 0);

ArrivalAt sun(const glm::dvec3& towards, const glm::dvec3& irradiance = glm::dvec3(1)) {
  return [=](std::size_t, const glm::dvec3&) { return Arrival{.towards = towards, .irradiance = irradiance}; };
}

/// The map of `media[chosen]` in the light of one sun.
VolumeLight mapOf(const std::vector<const Medium*>& media, std::size_t chosen, const glm::dvec3& towards,
                  const glm::ivec3& size, const glm::dvec3& irradiance = glm::dvec3(1)) {
  const ArrivalAt lights[]{sun(towards, irradiance)};
  return makeVolumeLight({.media = media, .chosen = chosen, .lights = lights, .towards = towards, .size = size});
}

VolumeLight mapOf(const Medium& medium, const glm::dvec3& towards, const glm::ivec3& size) {
  return mapOf({&medium}, 0, towards, size);
}

double lengthAhead(const VolumeSpace& space, const Ray& ray) {
  const auto line = insideUnitCube(toUnit(space, ray));
  return line ? std::max(0.0, line->to - std::max(line->from, 0.0)) : 0.0;
}

TEST(VolumeLight, D6_D7_AHomogeneousBoxTakesOneLessExpOfSigmaLOfTheLightForAnyPlaceLightAndResolution) {
  EXPECT_TRUE(rc::check([](unsigned seed) {
    Chances chances(seed);
    const glm::dvec3 middle = chances.below(2) * 1e5 * chances.direction();
    const glm::dvec3 size = 0.1 + 20.0 * chances.place();
    const bool turned = chances.below(2) == 1;
    const VolumeSpace space = turned ? turnedSpace(middle, size, chances.between(0, 7), chances.direction())
                                     : boxSpace(middle - size / 2.0, middle + size / 2.0);
    const double sigma = std::pow(10, chances.between(-4, 1));
    const Medium medium = homogeneous(space, sigma, {1 + chances.below(9), 1 + chances.below(9), 1 + chances.below(9)});
    // Along a face or edge of the box as often as anywhere.
    const glm::dvec3 along = glm::normalize(space.axes[chances.below(3)]);
    const glm::dvec3 towards = chances.below(2) == 0 ? (chances.below(2) == 0 ? along : -along) : chances.direction();
    const VolumeLight map = mapOf(medium, towards, {2 + chances.below(6), 2 + chances.below(6), 2 + chances.below(6)});
    for (int i = 0; i < 50; ++i) {
      const glm::dvec3 place = toWorld(space, 3.0 * chances.place() - 1.0);
      const double wanted = -std::expm1(-sigma * lengthAhead(space, {place, towards}));
      RC_ASSERT(std::abs(shareTaken(medium, map, place, towards) - wanted) < 5e-4);
    }
  }));
}

TEST(VolumeLight, D7_OnlyWhatIsBehindTheVolumeIsShaded) {
  const Medium medium = homogeneous(boxSpace({0, 10, 0}, {4, 12, 4}), 0.5);
  const VolumeLight map = mapOf(medium, kUp, {4, 4, 4});
  EXPECT_NEAR(shareTaken(medium, map, {2, 0, 2}, kUp), -std::expm1(-1.0), 1e-3);
  EXPECT_NEAR(shareTaken(medium, map, {2, 11, 2}, kUp), -std::expm1(-0.5), 1e-3);
  EXPECT_EQ(shareTaken(medium, map, {2, 12.001, 2}, kUp), 0); // the lit side
  EXPECT_EQ(shareTaken(medium, map, {2, 500, 2}, kUp), 0);
  EXPECT_EQ(shareTaken(medium, map, {4.001, 0, 2}, kUp), 0); // the light passes beside the box
  EXPECT_EQ(shareTaken(medium, map, {-3, 11, 2}, kUp), 0);
}

TEST(VolumeLight, D7_AGrazingLightAlongAFaceIsNeitherLostNorDoubled) {
  const Medium medium = homogeneous(boxSpace({0, 0, 0}, {4, 2, 4}), 0.5);
  for (const double tilt : {0.0, 1e-16, -1e-16, 1e-9, -1e-9}) {
    const glm::dvec3 towards = glm::normalize(glm::dvec3(1, tilt, 0));
    const VolumeLight map = mapOf(medium, towards, {3, 3, 3});
    EXPECT_NEAR(shareTaken(medium, map, {-1, 1, 2}, towards), -std::expm1(-2.0), 1e-3) << tilt;
    EXPECT_NEAR(shareTaken(medium, map, {1, 1e-6, 2}, towards), -std::expm1(-1.5), 1e-3) << tilt;
    EXPECT_EQ(shareTaken(medium, map, {-1, -1e-6, 2}, towards), 0) << tilt;
  }
}

TEST(VolumeLight, D7_SharesAreFineEnoughToShowNoBands) {
  const Medium medium = homogeneous(boxSpace({0, 0, 0}, {1, 1, 1}), 0.1);
  const VolumeLight map = mapOf(medium, kUp, {8, 8, 8});
  double last = 1;
  for (int i = 0; i <= 1000; ++i) {
    const double taken = shareTaken(medium, map, {0.5, i / 1000.0, 0.5}, kUp);
    EXPECT_LT(taken, last);
    EXPECT_NEAR(taken, -std::expm1(-0.1 * (1 - i / 1000.0)), 1e-4);
    last = taken;
  }
}

TEST(VolumeLight, D5_ACloudsShareIsThatOfARayFromAnyPlace) {
  const VolumeSpace space = turnedSpace({3, 20, -5}, {12, 6, 9}, 0.7, glm::normalize(glm::dvec3(1, 2, 3)));
  const Medium cloud = ball(space, 0.8, 48);
  const Medium* alone[]{&cloud};
  const glm::dvec3 towards = glm::normalize(glm::dvec3(0.4, 1, 0.2));
  double error[2]{};
  for (const int pass : {0, 1}) {
    const VolumeLight map = mapOf(cloud, towards, glm::ivec3(pass == 0 ? 17 : 49));
    Chances chances(7);
    for (int i = 0; i < 300; ++i) {
      const glm::dvec3 place = toWorld(space, 2.0 * chances.place() - 0.5);
      const double wanted = -std::expm1(-opticalDepth(alone, {place, towards}, {0, 1e9}, 0.1));
      error[pass] = std::max(error[pass], std::abs(shareTaken(cloud, map, place, towards) - wanted));
    }
  }
  EXPECT_LT(error[0], 0.05);
  EXPECT_LT(error[1], 0.01);
}

TEST(VolumeLight, D5_LightThatArrivesIsDimmedByAllMediaAndBySurfaces) {
  const Medium low = homogeneous(boxSpace({0, 0, 0}, {1, 1, 1}), 1),
               high = homogeneous(boxSpace({0, 5, 0}, {1, 6, 1}), 2);
  const glm::dvec3 irradiance(100000, 50000, 1);
  const VolumeLight map = mapOf({&low, &high}, 0, kUp, {2, 9, 2}, irradiance);
  for (const double height : {0.0, 0.5, 1.0}) {
    const glm::dvec3 wanted = irradiance * std::exp(-(1 - height) - 2.0);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(lightAt(map, {0.3, height, 0.8})[i] / wanted[i], 1, 2e-3);
  }
  // What the volume takes itself, and no more.
  EXPECT_NEAR(shareTaken(low, map, {0.5, -3, 0.5}, kUp), -std::expm1(-1.0), 1e-3);

  const Medium* media[]{&low};
  const ArrivalAt shaded[]{[](std::size_t, const glm::dvec3& place) {
    return Arrival{.towards = kUp, .irradiance = glm::dvec3(3), .surfaceVisibility = place.x < 0.5 ? 0.25 : 1.0};
  }};
  const VolumeLight dark =
      makeVolumeLight({.media = media, .chosen = 0, .lights = shaded, .towards = kUp, .size = {2, 2, 2}});
  EXPECT_NEAR(lightAt(dark, {0, 1, 0}).x, 0.75, 1e-3);
  EXPECT_NEAR(lightAt(dark, {1, 1, 0}).x, 3, 1e-3);
  EXPECT_NEAR(shareTaken(low, dark, {0.1, -3, 0.5}, kUp), -std::expm1(-1.0), 1e-3);
}

TEST(VolumeLight, D6_SharesOfSeveralVolumesMultiply) {
  const Medium low = homogeneous(boxSpace({0, 2, 0}, {4, 4, 4}), 0.3),
               high = homogeneous(boxSpace({2, 3, 0}, {6, 8, 4}), 0.2);
  const VolumeLight lowMap = mapOf({&low, &high}, 0, kUp, {3, 3, 3}), highMap = mapOf({&low, &high}, 1, kUp, {3, 3, 3});
  const MappedMedium media[]{{&low, &lowMap}, {&high, &highMap}};
  EXPECT_NEAR(volumeVisibility(media, {1, 0, 2}, kUp), std::exp(-0.6), 1e-3);
  EXPECT_NEAR(volumeVisibility(media, {3, 0, 2}, kUp), std::exp(-0.6 - 1.0), 1e-3);
  EXPECT_NEAR(volumeVisibility(media, {3, 3.5, 2}, kUp), std::exp(-0.15 - 0.9), 1e-3);
  EXPECT_NEAR(volumeVisibility(media, {5, 0, 2}, kUp), std::exp(-1.0), 1e-3);
  EXPECT_EQ(volumeVisibility(media, {7, 0, 2}, kUp), 1);
  EXPECT_EQ(volumeVisibility({}, {3, 0, 2}, kUp), 1);
}

TEST(VolumeLight, ALampDimsWithTheWayToItOnly) {
  const Medium medium = homogeneous(boxSpace({0, 0, 0}, {8, 1, 1}), 0.5);
  const Medium* media[]{&medium};
  const glm::dvec3 lamp(4, 0.5, 0.5);
  const ArrivalAt lights[]{[&](std::size_t, const glm::dvec3& place) {
    const double distance = std::max(glm::distance(place, lamp), 1e-9);
    return Arrival{.towards = (lamp - place) / distance, .distance = distance, .irradiance = glm::dvec3(1)};
  }};
  const VolumeLight map = makeVolumeLight({.media = media, .chosen = 0, .lights = lights, .size = {9, 3, 3}});
  EXPECT_NEAR(lightAt(map, {0, 0.5, 0.5}).x, std::exp(-2.0), 1e-3);
  EXPECT_NEAR(lightAt(map, {0.75, 0.5, 0.5}).x, std::exp(-1.0), 1e-3);
  EXPECT_EQ(shareTaken(medium, map, {4, -5, 0.5}, kUp), 0); // no light was chosen
}

TEST(VolumeLight, D7_AVolumeShadowsItselfOnce) {
  // Seen from where the light comes from: the light is dimmed on its way in, what is scattered on its way out.
  const Medium medium = homogeneous(boxSpace({0, 0, 0}, {1, 2, 1}), 1);
  const VolumeLight map = mapOf(medium, kUp, {2, 65, 2});
  const Medium* media[]{&medium};
  const Marched marched = march(
      media, {{0.5, 5, 0.5}, {0, -1, 0}}, {0, 10},
      [&](std::size_t, const glm::dvec3& unit) { return lightAt(map, unit); }, 0.02);
  EXPECT_NEAR(marched.color.x, 0.5 * -std::expm1(-4.0) / 2, 1e-3);
}

TEST(VolumeLight, CastingAndReceivingAreEachByThemselves) {
  Medium medium = homogeneous(boxSpace({0, 0, 0}, {1, 1, 1}), 1);
  medium.castShadow = false;
  const VolumeLight clear = mapOf(medium, kUp, {2, 3, 2});
  EXPECT_EQ(shareTaken(medium, clear, {0.5, -1, 0.5}, kUp), 0);
  EXPECT_NEAR(lightAt(clear, {0.5, 0, 0.5}).x, 1, 1e-3);
  medium.castShadow = true;
  medium.receiveShadow = false;
  const VolumeLight bright = mapOf(medium, kUp, {2, 3, 2});
  EXPECT_NEAR(shareTaken(medium, bright, {0.5, -1, 0.5}, kUp), -std::expm1(-1.0), 1e-3);
  EXPECT_NEAR(lightAt(bright, {0.5, 0, 0.5}).x, 1, 1e-3);
}

TEST(VolumeLight, IsAsFineAsTheGridUpToALimit) {
  const auto grid = gridOf({1, 40, 300}, [](const glm::dvec3&) { return 0.0; });
  EXPECT_EQ(volumeLightSize(*grid), glm::ivec3(2, 41, 64));
  EXPECT_EQ(volumeLightSize(*grid, 16), glm::ivec3(2, 16, 16));
}

} // namespace
} // namespace gnomon
