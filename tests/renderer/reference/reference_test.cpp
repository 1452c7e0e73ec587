#include "renderer/reference/reference.h"

#include <tbb/global_control.h>

#include "tests/renderer/rays/shapes.h"

namespace gnomon {
namespace {

using testing::addSphere;
using testing::addSquare;
using testing::GlbBuilder;
using testing::parallelView;
using testing::perspectiveView;
using testing::sunAlong;
using testing::Traced;

constexpr std::array<int, 2> kBoth{0, 1};

/// A ball on a floor, seen from aside, under a sun with a size and a lamp without.
Traced ballOnFloor() {
  GlbBuilder builder;
  addSquare(builder, 5, 0);
  addSphere(builder, {0.2, 1, 0}, 1, 40);
  Traced traced(builder);
  traced.width = 120;
  traced.height = 80;
  traced.camera = perspectiveView({3, 4, 5}, {0, 0.5, 0}, 45);
  traced.camera.halfSize.x *= 1.5;
  traced.lights = {sunAlong({0.5, -1, 0.2}, 4), testing::pointAt({-2, 3, 1})};
  return traced;
}

TEST(Reference, HoldsAValueForEveryPixel) {
  const Traced traced = ballOnFloor();
  const auto result = traceReference(traced.input(), kBoth, 16);
  ASSERT_TRUE(result);
  const Reference& truth = *result;
  EXPECT_EQ(truth.width, 120);
  EXPECT_EQ(truth.height, 80);
  EXPECT_EQ(truth.samples, 16);
  EXPECT_GT(truth.milliseconds, 0);
  ASSERT_EQ(truth.lights.size(), 2u);
  const std::vector<SurfacePoint> surface = traced.surface();
  ASSERT_EQ(truth.surface.size(), surface.size());
  int hidden = 0;
  for (int light = 0; light < 2; ++light) {
    const LightReference& of = truth.lights[std::size_t(light)];
    EXPECT_EQ(of.light, light);
    EXPECT_EQ(of.visibility, lightVisibility(traced.input(), light, surface, 16));
    EXPECT_EQ(of.receiver, facesLight(traced.input(), light, surface));
    const std::vector<float> distances = blockerDistances(traced.input(), light, surface);
    for (std::size_t i = 0; i < surface.size(); ++i) {
      if (of.visibility[i] >= 0.5f) {
        EXPECT_EQ(of.blockerDistance[i], std::numeric_limits<float>::infinity());
      } else {
        ++hidden;
        EXPECT_EQ(of.blockerDistance[i], distances[i] / truth.pixelWidth[i]);
      }
    }
  }
  EXPECT_GT(hidden, 500);
}

TEST(Reference, APixelsWidthGrowsWithItsDepthUnderPerspectiveOnly) {
  Traced traced = ballOnFloor();
  const std::array<int, 1> lights{1};
  Reference truth = traceReference(traced.input(), lights, 1).operator*();
  const SurfacePoint& point = truth.surface[60 * 120 + 20];
  ASSERT_NE(point.instance, kNoSurface);
  const double depth = glm::dot(point.position + traced.anchor() - traced.camera.eye, traced.camera.forward);
  EXPECT_NEAR(truth.pixelWidth[60 * 120 + 20], depth * 2 * traced.camera.halfSize.y / 80, 1e-6);
  EXPECT_EQ(truth.pixelWidth[0], 0) << "nothing is there";
  traced.camera = parallelView({0, 5, 0}, {0, -1, 0}, 8);
  truth = traceReference(traced.input(), lights, 1).operator*();
  EXPECT_FLOAT_EQ(truth.pixelWidth[0], 8.0f / 80);
}

TEST(Reference, WhatReceivesNoShadowIsNoReceiver) {
  Traced traced = ballOnFloor();
  traced.nodes = {{true, true, false, 1}, {}};
  const Reference truth = traceReference(traced.input(), kBoth, 1).operator*();
  for (std::size_t i = 0; i < truth.surface.size(); ++i) {
    if (truth.surface[i].instance != 0) continue;
    EXPECT_EQ(truth.lights[0].receiver[i], 0);
    EXPECT_EQ(truth.lights[0].visibility[i], 1);
  }
}

TEST(Reference, IsTheSameForAnyNumberOfThreadsAndAnyCompany) {
  const Traced traced = ballOnFloor();
  const Reference all = traceReference(traced.input(), kBoth, 64).operator*();
  {
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const Reference alone = traceReference(traced.input(), kBoth, 64).operator*();
    for (std::size_t light = 0; light < 2; ++light) {
      EXPECT_EQ(alone.lights[light].visibility, all.lights[light].visibility);
      EXPECT_EQ(alone.lights[light].blockerDistance, all.lights[light].blockerDistance);
    }
  }
  // Every seventh point alone, last first.
  for (int light = 0; light < 2; ++light) {
    const std::vector<float>& expected = all.lights[std::size_t(light)].visibility;
    for (std::size_t i = expected.size(); i >= 7; i -= 7) {
      const std::vector<float> again = lightVisibility(traced.input(), light, std::span(&all.surface[i - 1], 1), 64);
      EXPECT_EQ(again[0], expected[i - 1]) << i;
    }
  }
}

TEST(Reference, TellsItsProgressAndStopsWhenAsked) {
  Traced traced = ballOnFloor();
  std::vector<double> told;
  ASSERT_TRUE(traceReference(traced.input(), kBoth, 256, [&](double done) {
    told.push_back(done);
    return true;
  }));
  EXPECT_GE(told.size(), 3u);
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  EXPECT_EQ(told.back(), 1);
  int calls = 0;
  const auto stopped = traceReference(traced.input(), kBoth, 256, [&](double) { return ++calls < 2; });
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.problems()[0].code, ProblemCode::unavailable);
  EXPECT_EQ(calls, 2);
}

TEST(Reference, AnEmptySceneHasNoReceivers) {
  Traced traced{GlbBuilder{}};
  traced.camera = perspectiveView({1, 1, 1}, {0, 0, 0}, 50);
  const std::array<int, 1> lights{0};
  const Reference truth = traceReference(traced.input(), lights, 4).operator*();
  EXPECT_EQ(truth.lights[0].visibility, std::vector<float>(64 * 64, 1.0f));
  EXPECT_EQ(truth.lights[0].receiver, std::vector<std::uint8_t>(64 * 64, 0));
  EXPECT_EQ(truth.pixelWidth, std::vector<float>(64 * 64, 0.0f));
}

TEST(Reference, VerticesThatAreNotNumbersAndTrianglesWithoutAreaDoNoHarm) {
  GlbBuilder builder;
  addSquare(builder, 5, 0);
  addSphere(builder, {0.2, 1, 0}, 1, 40);
  Scene scene = load(builder);
  const Primitive& ball = scene.primitives[1];
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const auto added = std::uint32_t(scene.positions.size()) - ball.baseVertex;
  std::vector<glm::vec3>& positions = scene.positions.edit();
  positions.insert(positions.end(), {{0, 1.5f, nan}, {nan, nan, nan}, {1, 1.5f, 1}, {-1, 1.5f, -1}});
  scene.attributes.edit().resize(positions.size());
  std::vector<std::uint32_t>& indices = scene.indices.edit();
  indices.insert(indices.end(), {added, added + 2, added + 3, added + 1, added + 1, added + 1, added + 2, added + 2,
                                 added + 3, added + 3, added + 3, added + 3});
  scene.primitives[1].indexCount += 12;
  scene.primitives[1].vertexCount += 4;
  Traced broken(std::move(scene));
  Traced whole = ballOnFloor();
  broken.camera = whole.camera;
  broken.lights = whole.lights;
  broken.width = whole.width;
  broken.height = whole.height;
  const Reference truth = traceReference(whole.input(), kBoth, 16).operator*();
  const Reference found = traceReference(broken.input(), kBoth, 16).operator*();
  for (std::size_t light = 0; light < 2; ++light) {
    EXPECT_EQ(found.lights[light].visibility, truth.lights[light].visibility);
    EXPECT_EQ(found.lights[light].blockerDistance, truth.lights[light].blockerDistance);
  }
}

} // namespace
} // namespace gnomon
