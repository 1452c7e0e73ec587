#include "renderer/frame/volume_sky.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <numeric>

#include "tests/renderer/rays/shapes.h"
#include "tests/renderer/volume/media.h"

namespace gnomon {
namespace {

using testing::GlbBuilder;
using testing::Traced;

SkyLight skyOf(const std::function<glm::vec3(const glm::dvec3&)>& radiance) {
  return {std::make_shared<const EnvironmentSampler>(radiance, 2)};
}

SkyLight uniformSky() {
  return skyOf([](const glm::dvec3&) { return glm::vec3(1); });
}

const glm::dvec3 kWindow = glm::normalize(glm::dvec3(0.6, 0.7, 0.2));

SkyLight windowSky() {
  return skyOf([](const glm::dvec3& d) { return glm::vec3(glm::dot(d, kWindow) > 0.99 ? 500.0f : 0.1f); });
}

/// What arrives in `medium`, of radiance 1, beside a square of 1 km that faces up at height 0.
VolumeLight arriving(const SkyLight& sky, const Medium& medium, const glm::ivec3& size, int directions) {
  GlbBuilder builder;
  testing::addSquare(builder, 500, 0);
  const Traced traced(builder);
  const Medium* media[]{&medium};
  TraceInput input = traced.input();
  input.media = media;
  return skyInVolume(TracedSky(input), skyDirections(sky, directions), glm::dvec3(1), medium.space, size);
}

TEST(VolumeSky, DirectionsAddUpToTheLightOfTheSky) {
  for (const SkyLight& sky : {uniformSky(), windowSky()}) {
    const DirectionsOfSky found = skyDirections(sky, 256);
    const double sum = std::accumulate(found.light.begin(), found.light.end(), 0.0,
                                       [](double all, const glm::dvec3& light) { return all + light.y; });
    double truth = 0;
    const DirectionsOfSky many = skyDirections(uniformSky(), 200'000);
    for (const glm::dvec3& toward : many.towards) {
      truth += double{sky.sampler->radiance(glm::vec3(toward)).y} * 4 * glm::pi<double>() / 200'000;
    }
    EXPECT_NEAR(sum / truth, 1, 0.02);
  }
}

/// 1 in a sphere of directions, the mean of exp(-sigma * way) from the middle of a cube of side 2.
double fromMiddleOfCube(double sigma) {
  constexpr int kSteps = 400;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double height = 2 * (i + 0.5) / kSteps - 1, across = std::sqrt(1 - height * height);
    for (int k = 0; k < kSteps; ++k) {
      const double angle = 2 * glm::pi<double>() * (k + 0.5) / kSteps;
      const double largest =
          std::max({std::abs(height), std::abs(across * std::cos(angle)), std::abs(across * std::sin(angle))});
      sum += std::exp(-sigma / largest);
    }
  }
  return sum / (kSteps * kSteps);
}

TEST(VolumeSky, TheMiddleOfACubeGetsWhatItsWaysOutSay) {
  for (const double sigma : {0.1, 1.0, 4.0}) {
    // Far below the floor, so that it hides next to nothing.
    const Medium cube = homogeneous(boxSpace({-1, -100'001, -1}, {1, -99'999, 1}), sigma);
    const VolumeLight light = arriving(uniformSky(), cube, glm::ivec3(5), 256);
    const double wanted = fromMiddleOfCube(sigma);
    EXPECT_NEAR(lightAt(light, glm::dvec3(0.5)).y, wanted, 0.004) << sigma;
    EXPECT_GT(lightAt(light, glm::dvec3(0, 0.5, 0.5)).y, wanted) << "its face is nearer to the light";
  }
}

TEST(VolumeSky, AFloorHidesHalfOfIt) {
  const Medium clear = homogeneous(boxSpace({-1, 0.01, -1}, {1, 1, 1}), 1e-9);
  const VolumeLight light = arriving(uniformSky(), clear, glm::ivec3(4), 64);
  for (const glm::vec4& share : light.texels) EXPECT_NEAR(share.y, 0.5f, 0.02f);
  EXPECT_EQ(light.fullLight, glm::dvec3(1));
  // The window is above it, and the rest is next to nothing.
  const VolumeLight bright = arriving(windowSky(), clear, glm::ivec3(4), 64);
  for (const glm::vec4& share : bright.texels) EXPECT_GT(share.y, 0.97f);
}

TEST(VolumeSky, WhereNothingHidesAnyItIsExactlyAll) {
  const Medium clear = homogeneous(boxSpace({-1, 2, -1}, {1, 3, 1}), 0);
  GlbBuilder builder;
  testing::addSquare(builder, 1, 0);
  const Traced traced(builder);
  TraceInput input = traced.input();
  const std::vector<NodeSwitches> nothingCasts(traced.scene.scene().nodes.size(), NodeSwitches{.castShadow = false});
  input.nodes = nothingCasts;
  for (const SkyLight& sky : {uniformSky(), windowSky()}) {
    const VolumeLight light =
        skyInVolume(TracedSky(input), skyDirections(sky, 64), glm::dvec3(0.25), clear.space, glm::ivec3(64));
    EXPECT_EQ(light.size, glm::ivec3(kMostSkySide));
    EXPECT_TRUE(std::all_of(light.texels.begin(), light.texels.end(),
                            [](const glm::vec4& share) { return share == glm::vec4(1, 1, 1, 0); }));
    EXPECT_EQ(lightAt(light, {0.3, 0.4, 0.5}), glm::dvec3(0.25));
  }
  EXPECT_EQ(lightAt(openSky(glm::dvec3(0.25)), {0.3, 0.4, 0.5}), glm::dvec3(0.25));
}

TEST(VolumeSky, DirectionsAreCounted) {
  EXPECT_EQ(skyDirectionCount(1), 16);
  EXPECT_EQ(skyDirectionCount(4), 64);
  EXPECT_EQ(skyDirectionCount(1000), 1024);
}

} // namespace
} // namespace gnomon
