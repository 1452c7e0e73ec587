#include "renderer/frame/traced_scene_cache.h"

#include <gtest/gtest.h>
#include <thread>

#include "renderer/scene/scene.h"

namespace gnomon {
namespace {

/// One triangle, in each of two scenes of the file.
std::shared_ptr<const Scene> triangle(const std::string& content = {}) {
  Scene scene;
  scene.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  scene.attributes = std::vector<VertexAttributes>(3);
  scene.indices = {0, 1, 2};
  scene.welded = scene.indices;
  scene.materials.resize(1);
  scene.primitives.resize(1);
  Primitive& primitive = scene.primitives[0];
  primitive.content = content;
  primitive.vertexCount = primitive.indexCount = 3;
  for (const glm::vec3& position : scene.positions) primitive.bounds.add(glm::dvec3(position));
  scene.nodes.resize(1);
  SceneView view;
  view.instances.resize(1);
  view.instances[0].bounds = view.bounds = primitive.bounds;
  view.triangles = 1;
  scene.scenes = {view, view};
  return std::make_shared<const Scene>(std::move(scene));
}

std::shared_ptr<const TracedScene> got(TracedSceneCache& cache, const std::shared_ptr<const Scene>& scene,
                                       int index = 0) {
  auto traced = cache.get(scene, index);
  EXPECT_TRUE(traced);
  return traced ? *traced : nullptr;
}

TEST(TracedSceneCache, ASceneIsMadeOnce) {
  TracedSceneCache cache(1 << 20);
  const auto scene = triangle();
  const auto first = got(cache, scene);
  EXPECT_EQ(&first->scene(), scene.get());
  EXPECT_EQ(got(cache, scene), first);
  const auto second = got(cache, scene, 1);
  EXPECT_NE(second, first) << "another of the file's scenes";
  EXPECT_EQ(&second->view(), &scene->scenes[1]);
  EXPECT_EQ(got(cache, scene), first);
  EXPECT_NE(got(cache, triangle()), first) << "another file of the same content";
}

TEST(TracedSceneCache, ScenesOfKnownContentWithTheSameSurfacesShareOne) {
  TracedSceneCache cache(1 << 20);
  auto first = triangle("a triangle");
  auto second = triangle("a triangle");
  const std::weak_ptr<const TracedScene> traced = got(cache, first);
  EXPECT_EQ(got(cache, second), traced.lock());
  EXPECT_NE(got(cache, triangle("another")), traced.lock());
  first.reset();
  got(cache, triangle());
  EXPECT_EQ(got(cache, second), traced.lock()) << "the second scene still uses it";
  second.reset();
  got(cache, triangle());
  EXPECT_TRUE(traced.expired()) << "nobody does";
}

TEST(TracedSceneCache, TheLeastRecentlyUsedIsDroppedFirst) {
  const auto scenes = {triangle(), triangle(), triangle()};
  const auto* scene = scenes.begin();
  std::size_t each = 0;
  {
    TracedSceneCache cache(0);
    each = got(cache, scene[0])->bytes();
    EXPECT_GT(each, 0u);
    const std::weak_ptr<const TracedScene> first = got(cache, scene[0]);
    EXPECT_FALSE(first.expired()) << "the newest stays, whatever its size";
    got(cache, scene[1]);
    EXPECT_TRUE(first.expired());
  }
  TracedSceneCache cache(2 * each + each / 2);
  const std::weak_ptr<const TracedScene> first = got(cache, scene[0]);
  const std::weak_ptr<const TracedScene> second = got(cache, scene[1]);
  got(cache, scene[0]);
  got(cache, scene[2]);
  EXPECT_FALSE(first.expired());
  EXPECT_TRUE(second.expired());
}

TEST(TracedSceneCache, AnOlderSceneThatIsKeptAliveCounts) {
  constexpr std::size_t kPadding = 1 << 20; // of the older scene, where no ray reads it
  const auto padded = [] {
    Scene scene = *triangle("a triangle");
    scene.nodes.resize(kPadding / sizeof(SceneNode));
    return std::make_shared<const Scene>(std::move(scene));
  };
  const auto other = triangle();
  for (const bool isForgotten : {false, true}) {
    TracedSceneCache cache(kPadding);
    auto older = padded();
    const auto newer = triangle("a triangle");
    const std::weak_ptr<const TracedScene> traced = got(cache, older);
    if (isForgotten) {
      ASSERT_EQ(got(cache, newer), traced.lock());
      older.reset();
    }
    got(cache, other);
    EXPECT_EQ(traced.expired(), isForgotten);
  }
}

TEST(TracedSceneCache, AnyNumberOfSmallScenesCanBeTraced) {
  // A process has keys for a thousand of Embree's devices.
  TracedSceneCache cache(std::size_t{1} << 30);
  std::vector<std::shared_ptr<const Scene>> scenes;
  for (int i = 0; i < 1100; ++i) {
    scenes.push_back(triangle());
    ASSERT_TRUE(cache.get(scenes.back(), 0)) << i;
  }
}

TEST(TracedSceneCache, AForgottenSceneIsDropped) {
  TracedSceneCache cache(1 << 30);
  auto scene = triangle();
  const std::weak_ptr<const Scene> forgotten = scene;
  got(cache, scene, 0);
  got(cache, scene, 1);
  scene.reset();
  EXPECT_FALSE(forgotten.expired()) << "rays need its triangles";
  got(cache, triangle());
  EXPECT_TRUE(forgotten.expired());
}

TEST(TracedSceneCache, AnyThreadMayAsk) {
  TracedSceneCache cache(1 << 30);
  const std::vector<std::shared_ptr<const Scene>> scenes{triangle(), triangle()};
  std::vector<std::shared_ptr<const TracedScene>> traced(8);
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < traced.size(); ++i) {
    threads.emplace_back([&, i] { traced[i] = got(cache, scenes[i % 2]); });
  }
  for (std::thread& thread : threads) thread.join();
  for (std::size_t i = 2; i < traced.size(); ++i) EXPECT_EQ(traced[i], traced[i - 2]);
}

} // namespace
} // namespace gnomon
