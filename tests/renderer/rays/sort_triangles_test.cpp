#include <random>

#include "renderer/rays/tree.h"
#include "tests/renderer/rays/shapes.h"

namespace gnomon {
namespace {

using testing::GlbBuilder;
using testing::Traced;

constexpr int kInstances = 80; // enough to be worth a tree that they share

/// Balls of 480 triangles above a ground, turned, stretched and some mirrored.
Scene balls(double far) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-1, 1);
  GlbBuilder builder;
  testing::addSquare(builder, 30, -2);
  const int ball = builder.json["nodes"][std::size_t(testing::addSphere(builder, {0.3, 0, 0}, 1, 16))]["mesh"];
  for (int i = 1; i < kInstances; ++i) builder.addMeshNode(ball);
  for (auto& node : builder.json["nodes"]) {
    node["translation"] = {far, -far, far};
    if (node["mesh"] != ball) continue;
    node["translation"] = {far + 12 * place(random), -far + 2 + 2 * place(random), far + 12 * place(random)};
    const glm::dvec4 turn = glm::normalize(glm::dvec4(place(random), place(random), place(random), 1.5));
    node["rotation"] = {turn.x, turn.y, turn.z, turn.w};
    node["scale"] = {(place(random) < 0 ? -1 : 1) * (0.6 + 0.3 * place(random)), 0.8, 0.6};
  }
  return load(builder);
}

/// The same without any primitive that two instances share.
Scene apart(Scene scene) {
  for (Instance& instance : scene.scenes[0].instances) {
    scene.primitives.push_back(scene.primitives[std::size_t(instance.primitive)]);
    instance.primitive = int(scene.primitives.size()) - 1;
  }
  return scene;
}

void watch(Traced& traced) {
  traced.width = traced.height = 160;
  traced.camera = testing::perspectiveView(traced.anchor() + glm::dvec3(4, 14, 18), traced.anchor(), 60);
  traced.lights = {testing::sunAlong({0.4, -1, 0.2}), testing::sunAlong({0.4, -1, 0.2}, 8),
                   testing::pointAt(traced.anchor() + glm::dvec3(1, 9, 2), 0.5)};
}

TEST(SortTriangles, InstancesOfOneTreeAreMetWhereTheirTrianglesLie) {
  for (const double far : {0.0, 1e5}) {
    Traced shared(balls(far));
    Traced flat(apart(balls(far)));
    EXPECT_FALSE(shared.scene.tree().shared.empty());
    EXPECT_TRUE(flat.scene.tree().shared.empty());
    EXPECT_LT(shared.scene.bytes(), flat.scene.bytes());
    watch(shared);
    watch(flat);
    const std::vector<SurfacePoint> points = flat.surface();
    EXPECT_LE(testing::showingOthers(shared.surface(), points), 2);
    for (int light = 0; light < 3; ++light) {
      const std::vector<float> expected = lightVisibility(flat.input(), light, points, 8);
      const std::vector<float> shares = lightVisibility(shared.input(), light, points, 8);
      int differing = 0;
      for (std::size_t i = 0; i < points.size(); ++i) differing += shares[i] != expected[i];
      EXPECT_LE(differing, 3) << "light " << light;
    }
  }
}

TEST(SortTriangles, InstancesThatRoundBadlyAreSortedApart) {
  for (const bool flat : {true, false}) {
    GlbBuilder builder;
    const glm::dvec3 center = flat ? glm::dvec3(0) : glm::dvec3(1e5, 0, 0);
    const int ball = builder.json["nodes"][std::size_t(testing::addSphere(builder, center, 1, 16))]["mesh"];
    for (int i = 1; i < kInstances; ++i) builder.addMeshNode(ball);
    for (auto& node : builder.json["nodes"]) {
      node["translation"] = {-center.x, 0, 0};
      if (flat) node["scale"] = {1, 0, 1};
    }
    const Traced traced(builder);
    EXPECT_TRUE(traced.scene.tree().shared.empty());
  }
}

const glm::dvec3 kSlope = glm::normalize(glm::dvec3(0, 1, -1));

/// Balls in a corner of a slope of `size` metres, beside which they may be too small for floats to know their shape.
GlbBuilder ballsBeside(float size) {
  GlbBuilder builder;
  testing::addQuad(builder, {{0, 0, 0}, {0, size, size}, {size, size, size}, {size, 0, 0}});
  for (int i = 0; i < 40; ++i) testing::addSphere(builder, {0.1 * i, 0.5, 0}, 0.4, 16);
  return builder;
}

TEST(SortTriangles, WhatIsAPointBesideTheSceneIsLeftOut) {
  for (const float size : {1e2f, 1e6f, 1e8f, 1.9e9f}) {
    Traced traced(ballsBeside(size));
    traced.camera = testing::parallelView(traced.anchor() + kSlope * double{size}, -kSlope, 0.5 * size, 2.0 * size);
    traced.lights = {testing::sunAlong(-kSlope)};
    for (const SurfacePoint& point : traced.surface()) EXPECT_EQ(point.instance, 0u) << size;
    const std::vector<float> shares = lightVisibility(traced.input(), 0, traced.surface(), 1);
    EXPECT_EQ(std::ranges::count(shares, 1.0f), std::ptrdiff_t(shares.size())) << size;
  }
}

TEST(SortTriangles, AMeshThatIsPointsInPartKeepsItsOthersInTheirPlaces) {
  GlbBuilder builder = ballsBeside(4);
  for (int i = 0; i < 40; ++i) { // so that the triangles are many
    testing::addGrid(builder, 16, [&](double x, double z) {
      return x == 1 ? glm::dvec3(1.5e9, 7e8 * (z + 1), 7e8 * (z + 1)) : glm::dvec3(0.1 * i, 0.1 * x, 0.1 * z);
    });
  }
  Traced traced(builder);
  EXPECT_FALSE(traced.scene.tree().indices.empty());
  traced.camera = testing::parallelView(traced.anchor() + kSlope * 1e9, -kSlope, 1e9, 1e10);
  int hits = 0;
  for (const SurfacePoint& point : traced.surface()) {
    if (point.instance == kNoSurface) continue;
    ++hits;
    const Triangle triangle = traced.scene.tree().triangle(point.instance, point.triangle);
    EXPECT_GT(triangle.largest().x, 7e8) << "one of those that reach so far";
  }
  EXPECT_GT(hits, 0);
}

TEST(SortTriangles, ARayThatBeginsWhereFloatsEndMeetsNothing) {
  GlbBuilder builder;
  testing::addSquare(builder, 1e-9f, 0);
  Traced traced(builder);
  const TracedLight light(traced.input(), 0);
  const std::vector<glm::dvec3> places{{0, 1e12, 0}, {HUGE_VAL, 0, 0}, {0, -1e-9, 0}};
  std::vector<float> shares(places.size());
  light.airVisibility(places, shares);
  EXPECT_EQ(shares[0], 1);
  EXPECT_EQ(shares[1], 1);
}

} // namespace
} // namespace gnomon
