#include "renderer/prepare/frame_geometry.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

namespace gnomon {
namespace {

SceneView placedAt(const glm::dmat4& worldFromLocal) {
  SceneView view;
  Instance instance;
  instance.worldFromLocal = worldFromLocal;
  view.instances.push_back(instance);
  return view;
}

Scene oneCluster() {
  Scene scene;
  scene.primitives.resize(1);
  scene.primitives[0].clusterCount = 1;
  scene.clusters.push_back({{glm::dvec3(-1), glm::dvec3(1)}});
  return scene;
}

TEST(FrameGeometry, H12_FarFromTheOriginPositionsKeepTheirDigits) {
  const glm::dvec3 far(1e7 + 0.125, -1e7, 1e7);
  const SceneView view = placedAt(glm::translate(glm::dmat4(1), far));
  const FrameGeometry geometry = frameGeometry(oneCluster(), view, far - glm::dvec3(0.125, 0, 0));
  const glm::dvec3 origin(geometry.instances[0].relativeFromLocal * glm::dvec4(0, 0, 0, 1));
  EXPECT_EQ(origin, glm::dvec3(0.125, 0, 0));
  EXPECT_EQ(geometry.slotBounds[0].min, glm::dvec3(-0.875, -1, -1));
}

TEST(FrameGeometry, NormalsStandOnAScaledSurface) {
  const glm::dmat4 squashed = glm::scale(glm::dmat4(1), glm::dvec3(4, 1, 1));
  const FrameGeometry geometry = frameGeometry(oneCluster(), placedAt(squashed), glm::dvec3(0));
  // The plane x + y = 0, seen after the scale: its direction (1,-1,0) becomes (4,-1,0).
  const glm::dvec3 normal = geometry.instances[0].normalFromLocal * glm::dvec3(1, 1, 0);
  EXPECT_NEAR(glm::dot(glm::normalize(normal), glm::normalize(glm::dvec3(4, -1, 0))), 0.0, 1e-6);
}

TEST(FrameGeometry, G4_AMirrorTurnsNormalsAsItTurnsTheSurface) {
  const glm::dmat4 mirror = glm::scale(glm::dmat4(1), glm::dvec3(-1, 1, 1));
  const FrameGeometry geometry = frameGeometry(oneCluster(), placedAt(mirror), glm::dvec3(0));
  EXPECT_EQ(geometry.instances[0].normalFromLocal * glm::dvec3(1, 0, 0), glm::dvec3(-1, 0, 0));
  EXPECT_EQ(geometry.instances[0].normalFromLocal * glm::dvec3(0, 1, 0), glm::dvec3(0, 1, 0));
}

TEST(FrameGeometry, SurvivesTinyScales) {
  const glm::dmat4 tiny = glm::scale(glm::dmat4(1), glm::dvec3(1e-12));
  const FrameGeometry geometry = frameGeometry(oneCluster(), placedAt(tiny), glm::dvec3(0));
  EXPECT_NEAR(glm::length(geometry.instances[0].normalFromLocal * glm::dvec3(0, 0, 1)), 1.0, 1e-6);
}

} // namespace
} // namespace gnomon
