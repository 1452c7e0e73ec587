#include "renderer/rays/shadow_rays.h"

#include <gtest/gtest.h>
#include <random>
#include <rapidcheck.h>

#include "tests/renderer/rays/shapes.h"

namespace gnomon {
namespace {

using testing::GlbBuilder;
using testing::Point;
using testing::Traced;

/// From the floor at 10 m from the anchor, 45 degrees up, as far as `length`.
ShadowRay slanted(double length) {
  ShadowRay ray;
  ray.from.position = {10, 0, 0};
  ray.from.normal = {0, 1, 0};
  ray.from.corners = {{9, 0, -10}, {9, 0, 10}, {10, 0, 0}};
  ray.direction = glm::normalize(glm::dvec3(1, 1, 0));
  ray.length = length;
  return ray;
}

constexpr double kFar = std::numeric_limits<double>::infinity();

Triangle wallAt(double x, double height) {
  return {{x, -1, -5}, {x, height, 0}, {x, -1, 5}};
}

TEST(ShadowRays, MeetWhatStandsInTheirWay) {
  EXPECT_NEAR(meets(slanted(kFar), wallAt(12, 9)).value_or(-1), 2 * std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(meets(slanted(3), wallAt(12, 9)).value_or(-1), 2 * std::sqrt(2.0), 1e-12);
  EXPECT_FALSE(meets(slanted(2.8), wallAt(12, 9))) << "beyond the light";
  EXPECT_FALSE(meets(slanted(kFar), wallAt(9.999999, 9))) << "behind the start";
  EXPECT_TRUE(meets(slanted(kFar), wallAt(10.000001, 9)));
}

TEST(ShadowRays, PassWhatDoesNotRiseOverTheReceiversPlane) {
  EXPECT_FALSE(meets(slanted(kFar), wallAt(10, 0)));
  EXPECT_FALSE(meets(slanted(kFar), {{9, 0, -5}, {9, 0, 5}, {12, 0, 0}})) << "coplanar";
  // Heights are known to within the rounding of heights: those of a level floor are exact, however far it reaches.
  EXPECT_TRUE(meets(slanted(kFar), {{9, 1e-9, -5}, {9, 1e-9, 5}, {1e7, 2e-9, 0}}));
  ShadowRay raised = slanted(kFar);
  raised.from.position.y = 1;
  raised.from.corners = {{9, 1, -10}, {9, 1, 10}, {10, 1, 0}};
  EXPECT_FALSE(meets(raised, {{9, 1 + 1e-7, -5}, {9, 1, 5}, {12, 1, 0}}));
  EXPECT_TRUE(meets(raised, {{9, 1 + 1e-6, -5}, {9, 1, 5}, {12, 1, 0}}));
}

TEST(ShadowRays, PassTheLargeSheetInWhosePlaneASmallReceiverLies) {
  // A strip 1 cm wide of a floor 1 m over the anchor, one of its corners off by a rounding: 10 m on, its plane is off
  // by a thousand times as much.
  constexpr double kRounding = 0x1p-24;
  ShadowRay ray = slanted(kFar);
  ray.from.position = {9.995, 1, 0};
  ray.from.corners = {{10, 1 + kRounding, 0}, {9.99, 1, 0.1}, {9.99, 1, -0.1}};
  ray.from.normal = unitAlong(ray.from.corners.area());
  ray.from.normal *= ray.from.normal.y < 0 ? -1.0 : 1.0;
  const Triangle sheet{{0, 1, -10}, {0, 1, 10}, {20, 1, 0}};
  EXPECT_GT(glm::dot(ray.from.normal, sheet.a - ray.from.position), 1e-5) << "it rises over the receiver's plane";
  const auto raised = [&](double height) {
    return Triangle{{0, 1 + height, -10}, {0, 1 + height, 10}, {20, 1 + height, 0}};
  };
  EXPECT_FALSE(meets(ray, raised(1e-9)));
  EXPECT_FALSE(meets(ray, raised(kRounding)));
  EXPECT_TRUE(meets(ray, raised(1e-6)));
}

TEST(ShadowRays, PassTrianglesAlongTheirWayOrWithoutAnArea) {
  EXPECT_FALSE(meets(slanted(kFar), {{11, 1, 0}, {12, 2, 0}, {12, 2, 0}}));
  EXPECT_FALSE(meets(slanted(kFar), {{11, 1, 0}, {12, 2, 0}, {13, 3, 0}}));
  EXPECT_FALSE(meets(slanted(kFar), {{11, 5, 1}, {11, 5, 1}, {11, 5, 1}}));
}

/// A scene of one mesh of two triangles, the receiver and the caster; `node`: what else its node has.
Traced twoTriangles(const std::vector<Point>& corners, const nlohmann::json& node) {
  GlbBuilder builder;
  const int at = builder.addMeshNode(builder.addMesh({{"attributes", {{"POSITION", builder.addPoints(corners)}}}}));
  builder.json["nodes"][std::size_t(at)].update(node);
  return Traced(builder);
}

TEST(ShadowRays, PlacesInTheAirAreShadedByAllThatStandsBetweenThemAndTheLight) {
  const Traced base =
      twoTriangles({{-9, 5, -9}, {9, 5, -9}, {0, 5, 9}, {-9, 0, -9}, {9, 0, -9}, {0, 0, 9}}, nlohmann::json::object());
  std::vector<Light> lights{Light{.direction = Vec3{0, -1, 0}},
                            Light{.type = LightType::point, .position = Vec3{0, 3, 0}}};
  TraceInput input = base.input();
  input.lights = lights;
  const std::vector<glm::dvec3> world{{0, 6, 0}, {0, 4, 0}, {0, 1, 0}, {0, -1, 0}, {20, 4, 0}};
  std::vector<glm::dvec3> places;
  for (const glm::dvec3& place : world) places.push_back(place - base.anchor());
  std::vector<float> shares(places.size());
  TracedLight(input, 0).airVisibility(places, shares);
  EXPECT_EQ(shares, (std::vector<float>{1, 0, 0, 0, 1}));
  TracedLight(input, 1).airVisibility(places, shares);
  EXPECT_EQ(shares, (std::vector<float>{0, 1, 1, 0, 1}));
}

TEST(SurelyMeets, OnlyWhatMeetsFindsWhateverTheDistanceOfThePlanes) {
  int sure = 0;
  int unsure = 0;
  EXPECT_TRUE(rc::check([&] {
    std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
    std::uniform_real_distribution<double> place(-1, 1);
    const auto anywhere = [&] { return glm::dvec3(place(random), place(random), place(random)); };
    const double size = *rc::gen::element(1e-6, 1.0, 1e8);
    // From the receiver's plane: beyond rounding, about as far, within it, none.
    const double apart = *rc::gen::element(1.0, 1e-3, 1e-5, 3e-6, 1e-6, 3e-7, 1e-7, 0.0);
    const glm::dvec3 a = anywhere(), b = anywhere(), c = anywhere();
    const auto corner = [&] {
      const double u = place(random), v = place(random);
      return a + u * (b - a) + v * (c - a) + apart * anywhere();
    };
    std::vector<Point> corners;
    for (const glm::dvec3& p : {a, b, c, corner(), corner(), corner()}) {
      corners.push_back({float(p.x * size), float(p.y * size), float(p.z * size)});
    }
    const double far = std::min(*rc::gen::element(0.0, 10.0, 1e6) * size, 9e8); // within a scene's reach
    nlohmann::json node = {{"translation", {far, -far, far}}};
    if (*rc::gen::arbitrary<bool>()) node["scale"] = {-1, 2, 0.5};
    const Traced traced = twoTriangles(corners, node);
    const TracedScene::Tree& tree = traced.scene.tree();
    const Triangle receiver = tree.triangle(0, 0);
    const Triangle caster = tree.triangle(0, 1);
    const double rounding = roundingIn(tree);
    const glm::dvec3 eye = *rc::gen::element(1.0, 1e6) * size * anywhere();
    for (int i = 0; i < 50; ++i) {
      const double u = std::abs(place(random)), v = std::abs(place(random)) * (1 - u);
      SurfacePoint point{Barycentric{u, v}.mix(receiver.a, receiver.b, receiver.c),
                         glm::vec3(unitAlong(receiver.area())), 0, 0};
      if (i % 2 == 1) point.normal = -point.normal;
      // Towards the caster, or a grazing direction.
      const glm::dvec3 target = Barycentric{v, u * (1 - v)}.mix(caster.a, caster.b, caster.c);
      const glm::dvec3 along =
          i % 5 == 0 ? receiver.b - receiver.a + apart * size * anywhere() : target - point.position;
      const WayToLight way{unitAlong(along), i % 3 == 0 ? 1.5 * glm::length(along) : kFar};
      const ShadowRay exact{receiverAt(tree, eye, point), way.direction, way.length};
      if (surelyMeets({&point, way}, caster, rounding)) {
        ++sure;
        RC_ASSERT(meets(exact, caster).has_value());
      } else if (meets(exact, caster)) {
        ++unsure;
      }
    }
  }));
  EXPECT_GT(sure, 100) << "it spares something";
  EXPECT_GT(unsure, 100) << "the border was reached";
}

} // namespace
} // namespace gnomon
