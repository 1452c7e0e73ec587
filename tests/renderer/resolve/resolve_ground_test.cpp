#include "renderer/resolve/resolve_ground.h"

#include <cmath>
#include <gtest/gtest.h>

#include "renderer/resolve/ground_shadows.h"
#include "renderer/resolve/resolve_frame.h"
#include "renderer/scene/gltf_loader.h"
#include "renderer/scene/shared_content.h"
#include "tests/support/glb_builder.h"

namespace gnomon {
namespace {

using ScenePtr = std::shared_ptr<const Scene>;

ScenePtr triangleScene() {
  const auto scene = loadGltf({testing::triangle().glb(), {}});
  EXPECT_TRUE(scene);
  return *scene;
}

FrameSpec grounded(GroundMode mode = GroundMode::catcher) {
  FrameSpec spec;
  spec.ground = Ground{};
  spec.ground->mode = mode;
  return spec;
}

ScenePtr staged(const ScenePtr& loaded, const FrameSpec& spec) {
  const auto scene = stagedScene(loaded, spec);
  EXPECT_TRUE(scene) << scene.problems()[0].detail;
  return scene ? *scene : nullptr;
}

/// One box of two metres on y 0.
SceneView boxView() {
  SceneView view;
  view.instances.emplace_back();
  view.instances[0].bounds = view.bounds = {{-1, 0, -1}, {1, 2, 1}};
  return view;
}

FrameSpec litBy(const Light& light) {
  FrameSpec spec = grounded();
  spec.lights = std::vector{light};
  return spec;
}

Light sunAlong(const Vec3& direction) {
  Light light;
  light.direction = direction;
  return light;
}

TEST(StagedScene, WithoutAGroundIsThePose) {
  const ScenePtr loaded = triangleScene();
  EXPECT_EQ(staged(loaded, {}), loaded);
}

TEST(StagedScene, FramesThatAskForTheSameShareOne) {
  const ScenePtr loaded = triangleScene();
  FrameSpec spec = grounded();
  const ScenePtr first = staged(loaded, spec);
  spec.camera.orbit = Orbit{};
  spec.width = 99;
  EXPECT_EQ(staged(loaded, spec), first);
  const auto effective = resolveFrame(*first, spec);
  ASSERT_TRUE(effective);
  EXPECT_EQ(staged(loaded, effective->spec), first) << "what a report echoes asks for the same";
  spec.ground->height = -3;
  EXPECT_NE(staged(loaded, spec), first);
}

TEST(StagedScene, CopiesNoVertices) {
  const ScenePtr loaded = triangleScene();
  FrameSpec spec = grounded();
  const ScenePtr first = staged(loaded, spec);
  spec.ground->height = -3;
  for (const ScenePtr& scene : {first, staged(loaded, spec)}) {
    EXPECT_TRUE(scene->positions.sharesWith(loaded->positions));
    EXPECT_TRUE(scene->attributes.sharesWith(loaded->attributes));
    EXPECT_TRUE(scene->indices.sharesWith(loaded->indices));
    EXPECT_TRUE(scene->welded.sharesWith(loaded->welded));
    EXPECT_TRUE(sameMeshes(*scene, *loaded));
  }
}

TEST(StagedScene, BoundsAndCameraDoNotCountIt) {
  const ScenePtr loaded = triangleScene();
  const ScenePtr scene = staged(loaded, grounded(GroundMode::surface));
  EXPECT_EQ(scene->scenes[0].bounds.min, loaded->scenes[0].bounds.min);
  EXPECT_EQ(scene->scenes[0].bounds.max, loaded->scenes[0].bounds.max);
  EXPECT_EQ(resolveFrame(*scene, grounded())->spec.camera, resolveFrame(*loaded, {})->spec.camera);
}

TEST(StagedScene, ItsGroundReceivesAndCastsNothing) {
  const ScenePtr scene = staged(triangleScene(), grounded());
  const auto frame = resolveFrame(*scene, grounded());
  ASSERT_TRUE(frame);
  ASSERT_EQ(frame->nodes.size(), 2u);
  EXPECT_TRUE(frame->nodes[1].visible);
  EXPECT_TRUE(frame->nodes[1].receiveShadow);
  EXPECT_FALSE(frame->nodes[1].castShadow);
  EXPECT_TRUE(frame->nodes[0].castShadow);
}

TEST(StagedScene, AGroundBeyondReachIsAProblem) {
  FrameSpec spec = grounded();
  spec.ground->size = 8e9;
  const auto scene = stagedScene(triangleScene(), spec);
  ASSERT_FALSE(scene);
  EXPECT_EQ(scene.problems()[0].pointer, "/ground/size");
}

TEST(ShadowsOnGround, OfASlantedSunReachAsFarAsTheBoxIsHigh) {
  const auto shadow = shadowsOnGround(litBy(sunAlong({1, -1, 0})), boxView(), {}, 0);
  ASSERT_TRUE(shadow);
  EXPECT_NEAR(shadow->max.x, 3, 1e-9);
  EXPECT_NEAR(shadow->max.z, 1, 1e-9);
}

TEST(ShadowsOnGround, OfASunWithASizeReachFarther) {
  Light sun = sunAlong({1, -1, 0});
  sun.angularDiameterDegrees = 10;
  const auto shadow = shadowsOnGround(litBy(sun), boxView(), {}, 0);
  ASSERT_TRUE(shadow);
  EXPECT_GE(shadow->max.x, 1 + 2 / std::tan(40 * std::acos(-1.0) / 180));
  EXPECT_LT(shadow->max.x, 3.6);
}

TEST(ShadowsOnGround, OfALowSunAreEndless) {
  EXPECT_FALSE(shadowsOnGround(litBy(sunAlong({1, -0.01, 0})), boxView(), {}, 0));
}

TEST(ShadowsOnGround, OfALampSpreadFromIt) {
  Light lamp;
  lamp.type = LightType::point;
  lamp.position = Vec3{0, 4, 0};
  const auto shadow = shadowsOnGround(litBy(lamp), boxView(), {}, 0);
  ASSERT_TRUE(shadow);
  EXPECT_NEAR(shadow->max.x, 2, 1e-9);
  lamp.position = Vec3{3, 1, 0};
  EXPECT_FALSE(shadowsOnGround(litBy(lamp), boxView(), {}, 0)) << "lower than the box";
}

TEST(ShadowsOnGround, OfNothingAreNone) {
  Light light = sunAlong({1, -1, 0});
  light.shadow = Shadow{};
  light.shadow->enabled = false;
  const auto shadow = shadowsOnGround(litBy(light), boxView(), {}, 0);
  ASSERT_TRUE(shadow);
  EXPECT_TRUE(shadow->empty());
}

} // namespace
} // namespace gnomon
