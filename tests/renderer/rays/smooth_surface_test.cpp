#include "renderer/rays/smooth_surface.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "renderer/rays/tree.h"
#include "tests/renderer/rays/shapes.h"
#include "tests/renderer/smooth_mesh.h"

namespace gnomon {
namespace {

using testing::addSmoothBall;
using testing::GlbBuilder;
using testing::pointAt;
using testing::sunAlong;
using testing::Traced;

Traced ball(int columns, int rows) {
  GlbBuilder builder;
  builder.addMeshNode(addSmoothBall(builder, columns, rows));
  return Traced(builder);
}

SurfacePoint pointIn(const Traced& traced, std::uint32_t triangle, const Barycentric& at, double side = 1) {
  const Triangle placed = traced.scene.tree().triangle(0, triangle);
  const glm::dvec3 normal = side * unitAlong(placed.area());
  return {at.mix(placed.a, placed.b, placed.c), glm::vec3(normal), 0, triangle};
}

std::optional<SurfacePoint> smoothOf(const Traced& traced, const Light& light, const SurfacePoint& point) {
  const LightSource source = lightSource(light, traced.anchor());
  return smoothPoint(traced.scene.tree(), source, point, wayTo(source, point.position));
}

/// Anywhere within a triangle.
Barycentric somewhere() {
  const double u = *rc::gen::inRange(0, 1001) / 1000.0;
  return {u, (1 - u) * (*rc::gen::inRange(0, 1001) / 1000.0)};
}

glm::dvec3 someDirection() {
  const auto number = [] { return *rc::gen::inRange(-1000, 1001) / 1000.0; };
  const glm::dvec3 direction(number(), number(), number());
  return direction == glm::dvec3(0) ? glm::dvec3(0, -1, 0) : glm::normalize(direction);
}

std::uint32_t triangleCountOf(const Traced& traced) {
  return traced.scene.scene().primitives[0].indexCount / 3;
}

std::uint32_t someTriangle(const Traced& traced) {
  return *rc::gen::inRange<std::uint32_t>(0, triangleCountOf(traced));
}

TEST(SmoothSurface, OfABallItIsNearlyTheBall) {
  const Traced traced = ball(16, 8);
  rc::check([&] {
    const std::uint32_t triangle = someTriangle(traced);
    if (traced.scene.tree().triangle(0, triangle).isSliver()) return; // at the poles
    const SurfacePoint point = pointIn(traced, triangle, somewhere());
    // A sun along the triangle: part of what its shading shows faces it.
    const glm::dvec3 along = unitAlong(glm::cross(glm::dvec3(point.normal), someDirection()));
    const auto smooth = smoothOf(traced, sunAlong(-along), point);
    if (!smooth) return;
    RC_ASSERT(smooth->smooth);
    RC_ASSERT(std::abs(glm::length(smooth->position) - 1) < 0.004);
    RC_ASSERT(glm::dot(glm::dvec3(smooth->normal), unitAlong(smooth->position)) > 0.999);
    RC_ASSERT(glm::dot(smooth->normal, point.normal) > 0.9f);
  });
}

TEST(SmoothSurface, TakesTheTrianglesPlaceOnlyWhereThatIsTurnedAway) {
  const Traced traced = ball(16, 8);
  int taken = 0;
  for (std::uint32_t triangle = 0; triangle < triangleCountOf(traced); ++triangle) {
    if (traced.scene.tree().triangle(0, triangle).isSliver()) continue;
    const SurfacePoint point = pointIn(traced, triangle, {0.2, 0.3});
    const Light sun = sunAlong({-1, -0.3, 0.2});
    const LightSource source = lightSource(sun, traced.anchor());
    const auto smooth = smoothOf(traced, sun, point);
    if (!smooth) continue;
    ++taken;
    EXPECT_FALSE(faces(point.normal, wayTo(source, point.position)));
    EXPECT_TRUE(faces(smooth->normal, wayTo(source, smooth->position)));
  }
  EXPECT_GT(taken, 4);
}

TEST(SmoothSurface, OfATriangleThatASoftLightIsCutByItTakesThePlace) {
  const Traced traced = ball(16, 8);
  int sharp = 0, soft = 0;
  for (std::uint32_t triangle = 0; triangle < triangleCountOf(traced); ++triangle) {
    if (traced.scene.tree().triangle(0, triangle).isSliver()) continue;
    const SurfacePoint point = pointIn(traced, triangle, {0.6, 0.3});
    sharp += smoothOf(traced, sunAlong({-1, -0.3, 0.2}), point) ? 1 : 0;
    soft += smoothOf(traced, sunAlong({-1, -0.3, 0.2}, 20), point) ? 1 : 0;
  }
  EXPECT_GT(soft, sharp);
}

TEST(SmoothSurface, AHollowHasNone) {
  const Traced traced = ball(16, 8);
  for (std::uint32_t triangle = 0; triangle < triangleCountOf(traced); ++triangle) {
    const SurfacePoint inside = pointIn(traced, triangle, {0.2, 0.3}, -1);
    EXPECT_FALSE(smoothOf(traced, sunAlong({-1, -0.3, 0.2}), inside)) << triangle;
  }
}

TEST(SmoothSurface, AFlatMeshHasNone) {
  const Traced cube(testing::cube());
  for (std::uint32_t triangle = 0; triangle < 12; ++triangle) {
    EXPECT_FALSE(smoothOf(cube, sunAlong({-1, -0.3, 0.2}), pointIn(cube, triangle, {0.2, 0.3})));
    EXPECT_FALSE(smoothOf(cube, sunAlong({1, 0.3, 0.2}), pointIn(cube, triangle, {0.2, 0.3})));
  }
}

TEST(SmoothSurface, WhatMayNotFaceALightHasNoPointThatDoes) {
  const Traced traced = ball(8, 5);
  rc::check([&] {
    const std::uint32_t triangle = someTriangle(traced);
    const SurfacePoint point = pointIn(traced, triangle, somewhere());
    const bool lamp = *rc::gen::arbitrary<bool>();
    const Light light = lamp ? pointAt(2.5 * someDirection()) : sunAlong(someDirection());
    const LightSource source = lightSource(light, traced.anchor());
    if (!smoothOf(traced, light, point)) return;
    RC_ASSERT(mayFace(traced.scene.tree(), source, {0, triangle}, glm::dvec3(point.normal)));
  });
}

} // namespace
} // namespace gnomon
