#include "protocol/spec/settled_sun.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "protocol/spec/frame_lights.h"
#include "protocol/spec/validate.h"
#include "tests/protocol/found_problems.h"

namespace gnomon {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

Sun munich(const char* time) {
  return {.latitudeDegrees = 48.1, .longitudeDegrees = 11.6, .time = time};
}

FrameSpec litBy(const Sun& sun) {
  FrameSpec spec;
  spec.lights = std::vector<Light>{Light{.sun = sun}};
  return spec;
}

std::vector<std::string> wrongIn(const Sun& sun) {
  return pointersOf(validate(litBy(sun)));
}

TEST(SettledSun, WhatIsLeftOpenIsTheUsualPlace) {
  EXPECT_EQ(settledSun({}), (Sun{135, 45}));
  EXPECT_EQ(settledSun({.elevationDegrees = -10}), (Sun{135, -10}));
  EXPECT_FALSE(isNight({.elevationDegrees = -10}));
}

TEST(SettledSun, APlaceAndATimeGiveAzimuthAndElevationAlone) {
  const Sun sun = settledSun(munich("2026-06-21T17:00+02:00"));
  EXPECT_NEAR(*sun.azimuthDegrees, 261.42, 0.01);
  EXPECT_NEAR(*sun.elevationDegrees, 39.62, 0.01);
  EXPECT_EQ(sun, (Sun{sun.azimuthDegrees, sun.elevationDegrees}));
  EXPECT_EQ(settledSun(sun), sun);
}

TEST(SettledSun, NorthTurnsTheCompass) {
  Sun turned = munich("2026-06-21T17:00+02:00");
  const double azimuth = *settledSun(turned).azimuthDegrees;
  turned.northDegrees = 100;
  EXPECT_NEAR(*settledSun(turned).azimuthDegrees, azimuth + 100 - 360, 1e-9);
  turned.northDegrees = -360;
  EXPECT_NEAR(*settledSun(turned).azimuthDegrees, azimuth, 1e-9);
}

TEST(SettledSun, ALightIsSettledAndGoesOutAtNight) {
  const Light day = lightsOf(litBy(munich("2026-06-21T12:00+02:00")), {}).front();
  EXPECT_EQ(day.intensity, Light().intensity);
  EXPECT_TRUE(day.sun->azimuthDegrees && !day.sun->time);
  const Light night = lightsOf(litBy(munich("2026-06-21T23:30+02:00")), {}).front();
  EXPECT_EQ(night.intensity, 0);
  EXPECT_LT(*night.sun->elevationDegrees, -10);
  EXPECT_EQ(lightsOf(FrameSpec{}, {}).front().sun, (Sun{135, 45}));
  EXPECT_EQ(lightsOf(FrameSpec{}, {}).front().intensity, 2);
}

TEST(SunRules, APlaceNeedsATimeAndNoAzimuth) {
  EXPECT_THAT(wrongIn(munich("2026-06-21T17:00+02:00")), IsEmpty());
  EXPECT_THAT(wrongIn({.latitudeDegrees = 48.1}),
              UnorderedElementsAre("/lights/0/sun/longitudeDegrees", "/lights/0/sun/time"));
  Sun both = munich("2026-06-21T17:00+02:00");
  both.azimuthDegrees = 135;
  both.elevationDegrees = 45;
  EXPECT_THAT(wrongIn(both), UnorderedElementsAre("/lights/0/sun/azimuthDegrees", "/lights/0/sun/elevationDegrees"));
  EXPECT_THAT(wrongIn({.azimuthDegrees = 10, .northDegrees = 5}), ElementsAre("/lights/0/sun/northDegrees"));
}

TEST(SunRules, ATimeIsAMoment) {
  EXPECT_THAT(wrongIn(munich("17:00")), ElementsAre("/lights/0/sun/time"));
  EXPECT_THAT(wrongIn(munich("2016-12-31T23:59:60Z")), ElementsAre("/lights/0/sun/time"));
  FrameSpec spec;
  spec.environment.sky = Sky{.sun = munich("noon")};
  EXPECT_THAT(pointersOf(validate(spec)), ElementsAre("/environment/sky/sun/time"));
}

} // namespace
} // namespace gnomon
