#pragma once

#include <gtest/gtest.h>
#include <numbers>

#include "renderer/core/linear_algebra.h"
#include "renderer/rays/trace.h"
#include "renderer/reference/reference.h"
#include "tests/renderer/scene/load.h"

namespace gnomon::testing {

/// A scene ready for rays, with what else a frame of it needs.
struct Traced {
  explicit Traced(const GlbBuilder& builder) : Traced(load(builder)) {}
  explicit Traced(const SceneBundle& bundle) : Traced(load(bundle)) {}
  explicit Traced(Scene loaded)
      : scene(TracedScene::build(std::make_shared<const Scene>(std::move(loaded)), 0).operator*()) {}

  TraceInput input() const { return {scene, camera, width, height, lights, nodes}; }
  glm::dvec3 anchor() const { return anchorOf(scene.view()); }

  /// First hits of the centres of all pixels.
  std::vector<SurfacePoint> surface() const {
    std::vector<glm::vec2> places;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) places.emplace_back(float(x) + 0.5f, float(y) + 0.5f);
    }
    return firstHits(input(), places);
  }

  TracedScene scene;
  CameraView camera;
  int width = 64;
  int height = 64;
  std::vector<Light> lights{Light{}};
  std::vector<NodeSwitches> nodes;
};

/// How many show another triangle.
inline int showingOthers(const std::vector<SurfacePoint>& a, const std::vector<SurfacePoint>& b) {
  int count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    count += a[i].instance != b[i].instance || a[i].triangle != b[i].triangle;
  }
  return count;
}

/// From `eye` along `forward`; orthographic `height` metres high, or perspective with `fovY` degrees.
inline CameraView parallelView(const glm::dvec3& eye, const glm::dvec3& forward, double height, double far = 1e9) {
  CameraView view;
  view.eye = eye;
  view.forward = glm::normalize(forward);
  const glm::dvec3 up = std::abs(view.forward.y) > 0.9 ? glm::dvec3(0, 0, -1) : glm::dvec3(0, 1, 0);
  view.right = glm::normalize(glm::cross(view.forward, up));
  view.up = glm::cross(view.right, view.forward);
  view.perspective = false;
  view.halfSize = glm::dvec2(0.5 * height);
  view.near = 0;
  view.far = far;
  return view;
}

inline CameraView perspectiveView(const glm::dvec3& eye, const glm::dvec3& target, double fovYDegrees) {
  CameraView view = parallelView(eye, target - eye, 1);
  view.perspective = true;
  view.halfSize = glm::dvec2(std::tan(0.5 * glm::radians(fovYDegrees)));
  view.near = 1e-3 * glm::length(target - eye);
  view.far = std::numeric_limits<double>::infinity();
  return view;
}

inline Light sunAlong(const glm::dvec3& direction, double angularDiameterDegrees = 0) {
  Light light;
  light.direction = toTriple(direction);
  if (angularDiameterDegrees > 0) light.angularDiameterDegrees = angularDiameterDegrees;
  return light;
}

inline Light pointAt(const glm::dvec3& position, double radius = 0) {
  Light light;
  light.type = LightType::point;
  light.position = toTriple(position);
  if (radius > 0) light.radius = radius;
  return light;
}

} // namespace gnomon::testing
