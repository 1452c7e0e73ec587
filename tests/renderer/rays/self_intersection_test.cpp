#include <glm/gtx/rotate_vector.hpp>

#include "tests/renderer/rays/shapes.h"

namespace gnomon {
namespace {

using nlohmann::json;
using testing::addGrid;
using testing::addQuad;
using testing::addSphere;
using testing::GlbBuilder;
using testing::parallelView;
using testing::perspectiveView;
using testing::Point;
using testing::sunAlong;
using testing::Traced;

glm::dvec3 tilted(const glm::dvec3& v, double degrees) {
  return glm::rotate(glm::rotate(v, glm::radians(degrees), glm::dvec3(1, 0, 0)), 0.4, glm::dvec3(0, 1, 0));
}

/// Points of everything in view that face the light and yet do not see all of it, among `reached` that face it.
int falseShadows(const Traced& traced, int& reached) {
  const std::vector<SurfacePoint> points = traced.surface();
  const std::vector<std::uint8_t> faces = facesLight(traced.input(), 0, points);
  const std::vector<float> visibility = lightVisibility(traced.input(), 0, points, 64);
  int count = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    reached += faces[i];
    if (faces[i] != 0 && visibility[i] < 1) ++count;
  }
  return count;
}

struct Placing {
  double size;     // half a side, metres
  double distance; // from the origin, metres
  bool byNode;     // tilted by the node's rotation; else its vertices are
};

class FlatMesh : public ::testing::TestWithParam<Placing> {};

TEST_P(FlatMesh, NeverShadowsItselfHoweverTheLightGrazesIt) {
  const auto [size, distance, byNode] = GetParam();
  for (const double tilt : {0.0, 17.0, 60.0, 90.0, 143.0}) {
    GlbBuilder builder;
    const double bent = byNode ? 0.0 : tilt;
    addGrid(builder, 24, [&, scale = size](double x, double z) { return tilted(glm::dvec3(x, 0, z) * scale, bent); });
    json& node = builder.json["nodes"][0];
    node["translation"] = {distance, 0.3 * distance, -0.7 * distance};
    if (byNode) {
      const double half = 0.5 * glm::radians(tilt);
      node["rotation"] = {std::sin(half), 0, 0, std::cos(half)};
    }
    Traced traced(builder);
    const glm::dvec3 normal =
        byNode ? glm::rotate(glm::dvec3(0, 1, 0), glm::radians(tilt), glm::dvec3(1, 0, 0)) : tilted({0, 1, 0}, tilt);
    const glm::dvec3 along = glm::normalize(glm::cross(normal, glm::dvec3(0.3, 0.2, 0.9)));
    traced.camera = parallelView(traced.anchor() + normal * 3.0 * size, -normal, 2.7 * size, 10 * size);
    for (const double angle : {0.0, 45.0, 80.0, 89.0, 89.9, 89.99}) {
      const double radians = glm::radians(angle);
      traced.lights = {sunAlong(-(normal * std::cos(radians) + along * std::sin(radians)))};
      int reached = 0;
      EXPECT_EQ(falseShadows(traced, reached), 0) << "tilt " << tilt << ", light " << angle << " degrees off";
      EXPECT_GT(reached, 1000) << "tilt " << tilt << ", light " << angle << " degrees off";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(SelfIntersection, FlatMesh,
                         ::testing::Values(Placing{5, 0, false}, Placing{5, 0, true}, Placing{5, 1e6, false},
                                           Placing{5, 1e7, true}, Placing{1e-6, 0, false}, Placing{1e-6, 0, true},
                                           Placing{1e9, 0, false}, Placing{1e9, 0, true}));

TEST(SelfIntersection, AConvexBodyNeverShadowsTheFacesThatFaceTheLight) {
  for (const double size : {1e-6, 1.0, 1e9}) {
    GlbBuilder builder;
    addSphere(builder, glm::dvec3(0.3, 0.7, -0.2) * size, size, 96);
    Traced traced(builder);
    traced.width = traced.height = 200;
    traced.camera = perspectiveView(traced.anchor() + glm::dvec3(1, 2, 3) * size, traced.anchor(), 40);
    for (const glm::dvec3& light : {glm::dvec3(0, -1, 0), glm::dvec3(1, -1e-3, 0.2), glm::dvec3(-1, 0.5, -1)}) {
      traced.lights = {sunAlong(light)};
      int reached = 0;
      EXPECT_EQ(falseShadows(traced, reached), 0) << size;
      EXPECT_GT(reached, 1000) << size;
    }
  }
}

TEST(SelfIntersection, ALampsRaysDoNotMeetTheirOwnFloor) {
  GlbBuilder builder;
  addGrid(builder, 20, [](double x, double z) { return tilted(glm::dvec3(x, 0, z) * 50.0, 30); });
  Traced traced(builder);
  const glm::dvec3 normal = tilted({0, 1, 0}, 30);
  traced.camera = parallelView(traced.anchor() + normal * 100.0, -normal, 90);
  for (const double height : {1e-2, 1.0, 40.0}) {
    traced.lights = {testing::pointAt(traced.anchor() + normal * height)};
    int reached = 0;
    EXPECT_EQ(falseShadows(traced, reached), 0) << height;
    EXPECT_GT(reached, 1000) << height;
  }
}

TEST(SelfIntersection, ACoplanarCasterShadowsNothing) {
  for (const double tilt : {0.0, 33.0, 71.0}) {
    GlbBuilder builder;
    for (const float half : {5.0f, 0.7f, 300.0f}) {
      std::vector<Point> corners;
      for (const glm::dvec3& corner : {glm::dvec3(-half, 0, half), glm::dvec3(half, 0, half),
                                       glm::dvec3(half, 0, -half), glm::dvec3(-half, 0, -half)}) {
        const glm::dvec3 p = tilted(corner, tilt);
        corners.push_back({float(p.x), float(p.y), float(p.z)});
      }
      addQuad(builder, corners);
    }
    Traced traced(builder);
    const glm::dvec3 normal = tilted({0, 1, 0}, tilt);
    traced.camera = parallelView(traced.anchor() + normal * 10.0, -normal, 12);
    for (const double angle : {0.0, 60.0, 89.9}) {
      const glm::dvec3 along = tilted({0.6, 0, 0.8}, tilt);
      traced.lights = {sunAlong(-(normal * std::cos(glm::radians(angle)) + along * std::sin(glm::radians(angle))))};
      int reached = 0;
      EXPECT_EQ(falseShadows(traced, reached), 0) << tilt << " " << angle;
      EXPECT_GT(reached, 1000);
    }
  }
}

/// A floor and a wall that stands on it along z = 0, seen from 45 degrees above.
struct Corner : Traced {
  static GlbBuilder shape() {
    GlbBuilder builder;
    addQuad(builder, {{-4, 0, 7}, {4, 0, 7}, {4, 0, 0}, {-4, 0, 0}});
    addQuad(builder, {{-4, 0, 0}, {4, 0, 0}, {4, 3, 0}, {-4, 3, 0}});
    return builder;
  }
  explicit Corner(double viewed) : Traced(shape()) { camera = parallelView({0.1, 2, 2}, {0, -1, -1}, viewed); }
};

TEST(SelfIntersection, NeitherDoesOneThatTheEyeCanNotTellFromItsReceiver) {
  for (const float lift : {1e-16f, 1e-9f, 1e-7f}) {
    GlbBuilder builder;
    addSquare(builder, 50, 0);
    addSquare(builder, 40, lift);
    Traced traced(builder);
    traced.width = traced.height = 200;
    traced.camera = perspectiveView({3, 20, 30}, {0, 0, 0}, 60);
    for (const glm::dvec3& light : {glm::dvec3(0, -1, 0), glm::dvec3(1, -0.01, 0.3)}) {
      traced.lights = {sunAlong(light)};
      int reached = 0;
      EXPECT_EQ(falseShadows(traced, reached), 0) << lift;
      EXPECT_GT(reached, 10000);
    }
  }
}

/// What one can stumble over is no rounding, even in the far corner of a wide view.
TEST(SelfIntersection, LowCastersOfWideScenesKeepTheirShadows) {
  GlbBuilder builder;
  addSquare(builder, 500, 0);
  addQuad(builder, {{99, 0, 100}, {101, 0, 100}, {101, 1e-3f, 100}, {99, 1e-3f, 100}});
  Traced traced(builder);
  traced.nodes = {{}, {false, true, true, 1}};
  traced.camera = perspectiveView({100, 800, 600}, {100, 0, 100}, 1e-4);
  traced.lights = {sunAlong({0, -1, 2})};
  const std::vector<SurfacePoint> points = traced.surface();
  const std::vector<float> visibility = lightVisibility(traced.input(), 0, points, 1);
  int shadowed = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double behind = points[i].position.z + traced.anchor().z - 100;
    shadowed += visibility[i] == 0 ? 1 : 0;
    if (behind > 1e-4 && behind < 1.9e-3) {
      EXPECT_EQ(visibility[i], 0) << behind;
    }
    if (behind < -1e-4 || behind > 2.1e-3) {
      EXPECT_EQ(visibility[i], 1) << behind;
    }
  }
  EXPECT_GT(shadowed, 1000);
}

TEST(SelfIntersection, AConcaveCornerIsLitAndShadowedUpToItsEdge) {
  for (const double height : {4.0, 1e-2, 1e-4}) {
    Corner traced(height);
    traced.lights = {sunAlong({0.2, -1, -0.7})};
    int reached = 0;
    EXPECT_EQ(falseShadows(traced, reached), 0) << height;
    EXPECT_EQ(reached, traced.width * traced.height) << height;

    traced.lights = {sunAlong({0.2, -1, 0.4})}; // from behind the wall, which shadows 1.2 m of the floor
    const std::vector<SurfacePoint> points = traced.surface();
    const std::vector<float> visibility = lightVisibility(traced.input(), 0, points, 1);
    int floor = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const glm::dvec3 place = points[i].position + traced.anchor();
      if (points[i].instance != 0 || place.z > 1.19) continue;
      ++floor;
      EXPECT_EQ(visibility[i], 0) << place.z << " m before the wall";
    }
    EXPECT_GT(floor, 20) << height;
  }
}

} // namespace
} // namespace gnomon
