#include <array>
#include <gtest/gtest.h>

#include "renderer/shaders/shared/functions.h"

namespace gnomon::shared {
namespace {

constexpr std::array kShares{0.0f, 0.25f, 0.5f, 1.0f};

TEST(ShadowCatcher, OverAnyBackgroundIsThatTimesTheLightThatArrives) {
  const vec3 page(0.7f, 0.1f, 0.4f); // under the picture
  for (const float alpha : kShares) {
    for (const float lost : kShares) {
      const SeenLight behind = seenLight(vec3(0.0f), vec3(0.2f, 0.4f, 0.8f), alpha);
      const SeenLight seen = seenThroughCatcher(behind, caughtLight(3.0f, 3.0f * lost));
      const vec3 plain = behind.color * behind.alpha + page * (1 - behind.alpha);
      const vec3 caught = seen.color * seen.alpha + page * (1 - seen.alpha);
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(caught[c], plain[c] * (1 - lost), 1e-6f) << alpha << ' ' << lost;
    }
  }
}

TEST(ShadowCatcher, WhereNothingIsLostItIsExactlyWhatIsBehind) {
  for (const float alpha : kShares) {
    const SeenLight behind = seenLight(vec3(5.0f, 3.0f, 1.0f), vec3(0.1f, 0.3f, 0.7f), alpha);
    for (const CaughtLight caught : {caughtLight(0.3f, 0.0f), caughtLight(0.0f, 0.0f)}) {
      const SeenLight seen = seenThroughCatcher(behind, caught);
      EXPECT_EQ(seen.radiance, behind.radiance);
      EXPECT_EQ(seen.color, behind.color);
      EXPECT_EQ(seen.alpha, behind.alpha);
    }
  }
}

TEST(ShadowCatcher, DarkensSurroundingsThatAreSeenBehindIt) {
  const SeenLight seen = seenThroughCatcher(seenLight(vec3(8.0f), vec3(0.0f), 1.0f), caughtLight(2.0f, 0.5f));
  EXPECT_NEAR(seen.radiance.x, 6.0f, 1e-6f);
  EXPECT_EQ(seen.alpha, 1.0f);
}

TEST(ShadowCatcher, LightCountsByCosineAndLuminance) {
  const vec3 up(0, 1, 0);
  const CaughtLight slanted = caughtFrom(up, vec3(0.8f, 0.6f, 0), vec3(1, 2, 3), vec3(1, 0.5f, 0));
  EXPECT_NEAR(slanted.all, luminance(vec3(1, 2, 3)) * 0.6f / kPi, 1e-6f);
  EXPECT_NEAR(slanted.lost, luminance(vec3(0, 1, 3)) * 0.6f / kPi, 1e-6f);
  EXPECT_EQ(caughtFrom(up, vec3(0.8f, -0.6f, 0), vec3(1), vec3(0)).all, 0.0f) << "from below";
}

TEST(ShadowCatcher, LightOfAllSourcesIsOneShare) {
  const CaughtLight sun = caughtFrom(vec3(0, 1, 0), vec3(0, 1, 0), vec3(kPi), vec3(0));
  const CaughtLight sky = caughtAround(vec3(3), vec3(0.5f));
  EXPECT_NEAR(sun.all, 1.0f, 1e-6f);
  EXPECT_NEAR(sky.lost, 1.5f, 1e-6f);
  const SeenLight seen =
      seenThroughCatcher(seenLight(vec3(0), vec3(0), 0.0f), caughtLight(sun.all + sky.all, sun.lost + sky.lost));
  EXPECT_NEAR(seen.alpha, 2.5f / 4.0f, 1e-6f);
}

} // namespace
} // namespace gnomon::shared
