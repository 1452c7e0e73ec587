#include "renderer/resolve/framing.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "renderer/resolve/resolve_camera.h"
#include "tests/support/glb_builder.h"

namespace gnomon {
namespace {

using Points = std::vector<glm::dvec3>;

/// The margins of a picture, as shares of half of its shorter side; negative = something is cut.
struct Margins {
  double left = 0, right = 0, bottom = 0, top = 0;
  double least() const { return std::min({left, right, bottom, top}); }
};

Margins marginsOf(const CameraView& view, const Points& points) {
  glm::dvec2 low(HUGE_VAL), high(-HUGE_VAL);
  for (const glm::dvec3& point : points) {
    if (view.perspective && !(glm::dot(point - view.eye, view.forward) > 0)) return {-1, -1, -1, -1};
    const glm::dvec2 at = ndcOf(view, point - view.eye);
    low = glm::min(low, at);
    high = glm::max(high, at);
  }
  const glm::dvec2 scale = view.halfSize / std::min(view.halfSize.x, view.halfSize.y);
  return {(1 + low.x) * scale.x, (1 - high.x) * scale.x, (1 + low.y) * scale.y, (1 - high.y) * scale.y};
}

FramedSubject subjectOf(const Points& points) {
  Aabb bounds;
  for (const glm::dvec3& point : points) bounds.add(point);
  return subjectOf(bounds, [points](const glm::dvec3& way) {
    return *std::max_element(points.begin(), points.end(), [&](const glm::dvec3& a, const glm::dvec3& b) {
      return glm::dot(a, way) < glm::dot(b, way);
    });
  });
}

CameraView lookingAlong(const glm::dvec3& forward, const glm::dvec2& halfSize, const glm::dvec2& center = {0, 0}) {
  CameraView view;
  view.forward = glm::normalize(forward);
  view.right = glm::normalize(glm::cross(view.forward, glm::dvec3(0.1, 1, 0.02)));
  view.up = glm::cross(view.right, view.forward);
  view.halfSize = halfSize;
  view.center = center;
  return view;
}

double any(int low, int high) {
  return *rc::gen::inRange(low, high) / 1000.0;
}

TEST(Framing, AnyPointsFillThePictureButForAnEvenMargin) {
  EXPECT_TRUE(rc::check([] {
    const glm::dvec3 place = glm::dvec3(any(-1000, 1000), any(-1000, 1000), any(-1000, 1000)) * 100.0;
    const glm::dvec3 stretch(any(1, 3000), any(1, 3000), any(1, 3000));
    Points points;
    for (int i = *rc::gen::inRange(2, 40); i > 0; --i) {
      points.push_back(place + stretch * glm::dvec3(any(-1000, 1001), any(-1000, 1001), any(-1000, 1001)));
    }
    const glm::dvec2 half(any(30, 3000), any(30, 3000));
    const glm::dvec2 center(half.x * any(-990, 991), half.y * any(-990, 991));
    CameraView view = lookingAlong({any(-1000, 1000), any(-1000, 1000), any(1, 1000)}, half, center);
    const auto eye = framingEye(view, subjectOf(points));
    RC_ASSERT(eye.has_value());
    view.eye = *eye;
    const Margins margins = marginsOf(view, points);
    const bool isNear = subjectOf(points).radius < 1e-9; // all points in one place
    RC_PRE(!isNear);
    RC_ASSERT(std::abs(margins.left - margins.right) < 1e-6);
    RC_ASSERT(std::abs(margins.bottom - margins.top) < 1e-6);
    RC_ASSERT(margins.least() > 2 * kFramingMargin - 1e-6);
  }));
}

TEST(Framing, NothingNearerHoldsThem) {
  EXPECT_TRUE(rc::check([] {
    Points points{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int i = 0; i < 12; ++i) points.emplace_back(any(-1000, 1001), any(-1000, 1001), any(-1000, 1001));
    CameraView view =
        lookingAlong({any(-1000, 1000), any(-1000, 1000), any(1, 1000)}, {any(100, 2000), any(100, 2000)});
    const FramedSubject subject = subjectOf(points);
    view.eye = *framingEye(view, subject);
    const double nearest = glm::dot(subject.farthest(-view.forward) - view.eye, view.forward);
    RC_PRE(nearest > 1.01e-3 * subject.radius); // of a wide lens, the eye stops before it enters the subject
    RC_ASSERT(std::abs(marginsOf(view, points).least() - 2 * kFramingMargin) < 1e-6);
  }));
}

TEST(Framing, AnOrthographicPictureHasThemInItsMiddle) {
  const Points points{{0, 0, 0}, {1, 0, 0}, {0, 3, 0}, {5, 1, 2}};
  CameraView view = lookingAlong({0.3, -0.5, -1}, {5, 4});
  view.perspective = false;
  view.eye = *framingEye(view, subjectOf(points));
  const Margins margins = marginsOf(view, points);
  EXPECT_NEAR(margins.left, margins.right, 1e-12);
  EXPECT_NEAR(margins.top, margins.bottom, 1e-12);
}

TEST(Framing, ATargetThatIsGivenStaysAndAllIsSeen) {
  EXPECT_TRUE(rc::check([] {
    Points points;
    for (int i = 0; i < 12; ++i) points.emplace_back(any(-1000, 1001), any(-1000, 1001), any(-1000, 1001));
    const glm::dvec3 target(any(-1000, 1001), any(-1000, 1001), any(-1000, 1001));
    CameraView view =
        lookingAlong({any(-1000, 1000), any(-1000, 1000), any(1, 1000)}, {any(100, 2000), any(100, 2000)});
    const auto distance = framingDistance(view, target, subjectOf(points));
    RC_ASSERT(distance.has_value());
    view.eye = target - view.forward * *distance;
    const double least = marginsOf(view, points).least();
    RC_ASSERT(least > 0.04);
    view.eye = target - view.forward * (*distance * 0.98);
    RC_ASSERT(marginsOf(view, points).least() < least);
  }));
}

TEST(Framing, APointOrNothingIsSeenFromSomewhere) {
  for (const FramedSubject& subject : {subjectOf(Points{{3, 4, 5}}), subjectOf(Aabb{})}) {
    const CameraView view = lookingAlong({0, 0, -1}, {0.4, 0.3});
    const auto eye = framingEye(view, subject);
    ASSERT_TRUE(eye);
    EXPECT_GT(glm::dot(subject.center - *eye, view.forward), 0);
    EXPECT_TRUE(framingDistance(view, subject.center, subject));
  }
}

TEST(Framing, NoPlaceIsFoundWhereTheAxisLiesBesideThePicture) {
  const CameraView view = lookingAlong({0, 0, -1}, {0.4, 0.3}, {0.41, 0});
  EXPECT_FALSE(framingEye(view, subjectOf(Points{{1, 0, 0}, {0, 1, 0}})));
  EXPECT_FALSE(framingDistance(view, {0, 0, 0}, subjectOf(Points{{1, 0, 0}, {0, 1, 0}})));
}

/// A primitive of so many random triangles in clusters of their own boxes.
Scene randomScene() {
  Scene scene;
  std::vector<glm::vec3> positions;
  std::vector<std::uint32_t> indices;
  const auto triangles = *rc::gen::inRange<std::uint32_t>(1, 3 * kClusterTriangles);
  for (std::uint32_t i = 0; i < 3 * triangles; ++i) {
    // Cheap and uneven: far points are rare.
    const double t = 0.7 * i, r = i % 97 == 0 ? 2 : 1;
    positions.emplace_back(r * std::cos(t), r * std::sin(1.3 * t), r * std::cos(2.1 * t + 1));
    indices.push_back(i);
  }
  positions.emplace_back(99, 99, 99); // of no triangle
  Primitive primitive;
  primitive.vertexCount = static_cast<std::uint32_t>(positions.size());
  primitive.indexCount = 3 * triangles;
  for (std::uint32_t first = 0; first < triangles; first += kClusterTriangles) {
    Cluster cluster;
    for (std::uint32_t i = 3 * first; i < 3 * std::min(triangles, first + kClusterTriangles); ++i) {
      cluster.bounds.add(glm::dvec3(positions[i]));
      primitive.bounds.add(glm::dvec3(positions[i]));
    }
    scene.clusters.push_back(cluster);
    ++primitive.clusterCount;
  }
  scene.primitives.push_back(primitive);
  scene.positions = std::move(positions);
  scene.indices = std::move(indices);
  return scene;
}

TEST(SeenExtent, TheFarthestPointIsThatOfAllVisibleTriangles) {
  EXPECT_TRUE(rc::check([] {
    const Scene scene = randomScene();
    SceneView view;
    std::vector<NodeSwitches> nodes;
    Points points;
    for (int i = 0; i < 4; ++i) {
      Instance instance;
      instance.node = i;
      for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 3; ++row) instance.worldFromLocal[column][row] = any(-3000, 3001);
      }
      instance.bounds = transformed(instance.worldFromLocal, scene.primitives[0].bounds);
      view.instances.push_back(instance);
      nodes.push_back({.visible = i != 2});
      if (i == 2) continue;
      for (std::uint32_t k = 0; k < scene.primitives[0].indexCount; ++k) {
        points.emplace_back(instance.worldFromLocal * glm::dvec4(glm::dvec3(scene.positions[k]), 1));
      }
    }
    SeenExtent seen(scene, view, nodes);
    RC_ASSERT(!seen.empty());
    for (int i = 0; i < 6; ++i) {
      const glm::dvec3 way(any(-1000, 1001), any(-1000, 1001), any(1, 1001));
      double most = -HUGE_VAL;
      for (const glm::dvec3& point : points) most = std::max(most, glm::dot(point, way));
      RC_ASSERT(std::abs(glm::dot(seen.farthest(way), way) - most) < 1e-9);
    }
  }));
}

TEST(SeenExtent, WithoutEntriesAllIsVisibleAndHiddenNodesAreNone) {
  const Scene scene;
  SceneView view;
  view.instances.emplace_back();
  view.instances.back().bounds = {glm::dvec3(0), glm::dvec3(1)};
  EXPECT_FALSE(SeenExtent(scene, view, {}).empty());
  const std::vector<NodeSwitches> hidden{{.visible = false}};
  EXPECT_TRUE(SeenExtent(scene, view, hidden).empty());
}

} // namespace
} // namespace gnomon
