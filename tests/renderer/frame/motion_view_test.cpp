#include "renderer/frame/motion_view.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace gnomon {
namespace {

double number(int lowest, int highest) {
  return *rc::gen::inRange(lowest * 1024, highest * 1024) / 1024.0;
}

glm::dvec3 point(int lowest, int highest) {
  return {number(lowest, highest), number(lowest, highest), number(lowest, highest)};
}

/// Looks along -Z, turned a little about Y and rolled.
CameraView anyCamera() {
  CameraView camera;
  camera.eye = point(-1, 1);
  const double yaw = number(-1, 1) / 4, roll = number(-3, 3);
  camera.forward = {std::sin(yaw), 0, -std::cos(yaw)};
  const glm::dvec3 side = glm::cross(camera.forward, glm::dvec3(0, 1, 0));
  camera.right = side * std::cos(roll) + glm::dvec3(0, 1, 0) * std::sin(roll);
  camera.up = glm::cross(camera.right, camera.forward);
  camera.perspective = *rc::gen::arbitrary<bool>();
  const double half = camera.perspective ? number(1, 2) : number(20, 40);
  camera.halfSize = {half * 1.5, half};
  return camera;
}

/// By the definition of a picture of 300 by 200 pixels.
glm::dvec2 pixelOf(const CameraView& camera, const glm::dvec3& world) {
  const glm::dvec3 seen = world - camera.eye;
  const double depth = camera.perspective ? glm::dot(seen, camera.forward) : 1;
  const double x = glm::dot(seen, camera.right) / depth / camera.halfSize.x;
  const double y = glm::dot(seen, camera.up) / depth / camera.halfSize.y;
  return {(1 + x) * 150, (1 - y) * 100};
}

glm::dmat4 anyPlace() {
  glm::dmat4 place = glm::translate(glm::dmat4(1), glm::dvec3(0, 0, -30) + point(-2, 2));
  place = glm::rotate(place, number(-1, 1) / 2, glm::dvec3(0, 1, 0));
  return glm::scale(place, {number(1, 3), number(1, 3), -number(1, 3)});
}

/// One triangle.
Scene triangleAt(const glm::dmat4& place) {
  Scene scene;
  scene.positions = {{-5, -5, 0}, {6, -4, 1}, {1, 7, 2}};
  scene.indices = {0, 1, 2};
  Primitive primitive;
  primitive.vertexCount = primitive.indexCount = 3;
  scene.primitives.push_back(primitive);
  SceneView view;
  Instance instance;
  instance.worldFromLocal = place;
  view.instances.push_back(instance);
  scene.scenes.push_back(view);
  return scene;
}

RC_GTEST_PROP(MotionView, IsHowFarAPointOfATriangleMovesInThePicture, ()) {
  const glm::dmat4 placeNow = anyPlace(), placeThen = anyPlace();
  const Scene now = triangleAt(placeNow);
  const CameraView camera = anyCamera();
  const EarlierMoment earlier{std::make_shared<const Scene>(triangleAt(placeThen)), 0, anyCamera(), {}, {0}};
  const ShownGeometry shown{now, now.scenes[0], camera, 300, 200, {}, &earlier};

  const double b = number(0, 1) / 2, c = number(0, 1) / 2;
  const glm::dvec4 local((1 - b - c) * glm::dvec3(-5, -5, 0) + b * glm::dvec3(6, -4, 1) + c * glm::dvec3(1, 7, 2), 1);
  const glm::dvec2 seen = pixelOf(camera, glm::dvec3(placeNow * local));
  const glm::dvec2 before = pixelOf(earlier.camera, glm::dvec3(placeThen * local));
  const glm::dvec2 motion = motionAt(shown, earlier, {0, 0}, seen);
  RC_ASSERT(glm::length(motion - (seen - before)) < 1e-6 * (1 + glm::length(seen) + glm::length(before)));
}

TEST(MotionView, IsExactlyZeroWhereNothingMoves) {
  const Scene scene = triangleAt(glm::rotate(glm::translate(glm::dmat4(1), {0.3, 0.7, -9}), 0.4, {0.6, 0.8, 0}));
  const CameraView camera{.eye = {0.1, 0.2, 0.3}, .halfSize = {0.77, 0.43}};
  const EarlierMoment earlier{std::make_shared<const Scene>(scene), 0, camera, {}, {0}};
  const ShownGeometry shown{scene, scene.scenes[0], camera, 300, 200, {}, &earlier};
  for (double x = 100.5; x < 200; ++x) EXPECT_EQ(motionAt(shown, earlier, {0, 0}, {x, 100.5}), glm::dvec2(0));
}

TEST(MotionView, IsInfiniteWithoutASurfaceOrAPlaceBefore) {
  const Scene scene = triangleAt(glm::translate(glm::dmat4(1), {0, 0, -9}));
  const CameraView camera;
  CameraView away = camera;
  away.eye.z = -20;
  const glm::dvec2 none(std::numeric_limits<double>::infinity());
  EarlierMoment earlier{std::make_shared<const Scene>(scene), 0, away, {}, {0}};
  const ShownGeometry shown{scene, scene.scenes[0], camera, 300, 200, {}, &earlier};
  EXPECT_EQ(motionAt(shown, earlier, {0, 0}, {150, 100}), none) << "behind the camera then";
  EXPECT_EQ(motionAt(shown, earlier, {}, {150, 100}), none) << "nothing is seen";
  earlier.camera = camera;
  EXPECT_EQ(motionAt(shown, earlier, {0, 0}, {150, 100}), glm::dvec2(0));
  earlier.instances = {kNoSurface};
  EXPECT_EQ(motionAt(shown, earlier, {0, 0}, {150, 100}), none) << "it was not there";
}

} // namespace
} // namespace gnomon
