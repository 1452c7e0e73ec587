#include "renderer/environment/sky_model.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <numbers>

#include "renderer/core/light.h"

namespace gnomon {
namespace {

Sky skyOf(double elevation, double turbidity = 2, double albedo = 0.2) {
  return {.turbidity = turbidity, .albedo = {albedo, albedo, albedo}, .sun = {90, elevation}};
}

/// A sky that several tests look at is computed once.
const Environment& clear(double elevation) {
  static std::map<double, Environment> made;
  const auto found = made.find(elevation);
  return found != made.end() ? found->second : made.emplace(elevation, skyEnvironment(skyOf(elevation))).first->second;
}

/// Of level ground by the sky alone, lux.
glm::dvec3 onGround(const EnvironmentMap& map) {
  glm::dvec3 sum(0);
  for (int y = 0; y < map.height / 2; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const double up = environmentDirection({(x + 0.5) / map.width, (y + 0.5) / map.height}).y;
      sum += glm::dvec3(map.at(x, y)) * (up * texelSolidAngle(map, y));
    }
  }
  return sum;
}

// IES RP-21, "Recommended practice for the calculation of daylight availability" (Journal of the IES 13 (4), 1984), for
// clear days: 127.5 exp(-0.21 / sin h) klux from the sun, 0.8 + 15.5 sqrt(sin h) klux from the sky on level ground.
TEST(SkyModel, SunAndSkyAreAsBrightAsMeasured) {
  for (const double elevation : {10, 30, 60, 90}) {
    const double sine = std::sin(elevation * std::numbers::pi / 180);
    const Environment& sky = clear(elevation);
    const double sun = 127'500 * std::exp(-0.21 / sine), ground = 800 + 15'500 * std::sqrt(sine);
    EXPECT_NEAR(luminanceOf(sky.sun->irradiance), sun, 0.1 * sun) << elevation;
    EXPECT_NEAR(luminanceOf(onGround(sky.map)), ground, 0.2 * ground) << elevation;
  }
}

TEST(SkyModel, ItGetsDarkAfterSunset) {
  const double set = luminanceOf(onGround(clear(0).map)), later = luminanceOf(onGround(clear(-3).map));
  const double night = luminanceOf(onGround(clear(-12).map));
  EXPECT_GT(set, 400); // with the sun on the horizon 400 to 1000 lux, and 3.4 at the end of civil twilight, -6 degrees
  EXPECT_LT(set, 1000);
  EXPECT_LT(later, set / 4);
  EXPECT_GT(later, 3.4);
  EXPECT_LT(night, 0.1);
  EXPECT_FALSE(clear(-3).sun);
}

TEST(SkyModel, TheZenithIsBlueAndALowSunIsRed) {
  const glm::vec3 zenith = clear(30).map.at(0, 0);
  EXPECT_GT(zenith.b, 2 * zenith.r);
  const auto redness = [](double elevation) {
    const glm::dvec3 sun = clear(elevation).sun->irradiance;
    return sun.r / sun.g;
  };
  EXPECT_LT(redness(60), 1.3);
  EXPECT_GT(redness(2), 3);
}

TEST(SkyModel, HazeWhitensTheSkyAndDimsTheSun) {
  const Environment hazy = skyEnvironment(skyOf(30, 10));
  const glm::vec3 blue = clear(30).map.at(0, 0), white = hazy.map.at(0, 0);
  EXPECT_LT(white.b / white.r, 0.6 * blue.b / blue.r);
  EXPECT_LT(luminanceOf(hazy.sun->irradiance), 0.3 * luminanceOf(clear(30).sun->irradiance));
  EXPECT_GT(luminanceOf(onGround(hazy.map)), luminanceOf(onGround(clear(30).map)));
}

TEST(SkyModel, GroundReflectsWhatArrivesAndBrightensTheSky) {
  const Environment black = skyEnvironment(skyOf(30, 2, 0)), white = skyEnvironment(skyOf(30, 2, 1));
  EXPECT_EQ(black.map.at(100, 255), glm::vec3(0));
  EXPECT_GT(luminanceOf(onGround(white.map)), 1.1 * luminanceOf(onGround(black.map)));
  const glm::dvec3 arrives = onGround(white.map) + 0.5 * white.sun->irradiance;
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(white.map.at(100, 128)[i], arrives[i] / std::numbers::pi, 1e-3 * arrives[i]);
    EXPECT_EQ(white.map.at(100, 128)[i], white.map.at(17, 255)[i]);
  }
  const Environment red = skyEnvironment({.turbidity = 2, .albedo = {1, 0, 0}, .sun = {90, 30}});
  EXPECT_GT(onGround(red.map).r, 1.05 * onGround(black.map).r);
  EXPECT_NEAR(onGround(red.map).b, onGround(black.map).b, 0.03 * onGround(black.map).b);
}

TEST(SkyModel, TheSunIsWhereItIsBrightest) {
  for (const double azimuth : {0.0, 90.0, 200.0}) {
    const Environment sky = skyEnvironment({.turbidity = 3, .sun = {azimuth, 20}});
    const auto brightest = std::max_element(sky.map.texels.begin(), sky.map.texels.end(),
                                            [](const glm::vec3& a, const glm::vec3& b) { return a.g < b.g; });
    const auto index = static_cast<int>(brightest - sky.map.texels.begin());
    const glm::dvec3 there = environmentDirection({(index % 512 + 0.5) / 512, (index / 512 + 0.5) / 256});
    // A little lower than the sun, where the air is thicker.
    EXPECT_GT(glm::dot(there, sky.sun->towards), std::cos(3 * std::numbers::pi / 180)) << azimuth;
    EXPECT_EQ(sky.sun->towards, towardsSun({azimuth, 20}));
    EXPECT_NEAR(sky.sun->angularDiameter * 180 / std::numbers::pi, 0.53, 0.01);
  }
}

TEST(SkyModel, EveryNumberIsFiniteAndNotNegative) {
  for (const double turbidity : {1.0, 10.0}) {
    for (const double elevation : {-90.0, -1.0, -0.2, 0.0, 0.1, 45.0, 90.0}) {
      const Environment sky = skyEnvironment(skyOf(elevation, turbidity, turbidity > 1 ? 1 : 0));
      const bool good = std::all_of(sky.map.texels.begin(), sky.map.texels.end(), [](const glm::vec3& texel) {
        return std::isfinite(texel.r + texel.g + texel.b) && texel.r >= 0 && texel.g >= 0 && texel.b >= 0;
      });
      EXPECT_TRUE(good) << turbidity << " " << elevation;
    }
  }
}

TEST(SkyModel, TheSunFadesWithoutAJump) {
  double before = 0;
  for (double elevation = -1; elevation <= 90; elevation += 0.01) {
    const auto sun = sunOf(skyOf(elevation));
    const double lux = sun ? luminanceOf(sun->irradiance) : 0;
    EXPECT_GE(lux, before) << elevation;
    EXPECT_LT(lux - before, 60) << elevation;
    before = lux;
  }
  EXPECT_FALSE(sunOf(skyOf(-0.32)));
  EXPECT_GT(before, 90'000);
}

TEST(SkyModel, TheSameSkyHasTheSameBits) {
  const Environment again = skyEnvironment(skyOf(10));
  EXPECT_TRUE(again.map.texels == clear(10).map.texels);
}

} // namespace
} // namespace gnomon
