#include "renderer/resolve/resolve_nodes.h"

#include <gtest/gtest.h>

#include "protocol/spec/limits.h"

namespace gnomon {
namespace {

/// "town" 0 holds "house" 1, which holds "lamp" 2 and "lamp" 3; a nameless 4 stands alone.
Scene town() {
  Scene scene;
  scene.nodes = {{"town", -1}, {"house", 0}, {"lamp", 1}, {"lamp", 1}, {"", -1}};
  scene.materials.resize(2);
  scene.materials[1].unlit = true;
  scene.primitives.resize(1);
  return scene;
}

/// A view that places every node once.
SceneView placing(const Scene& scene) {
  SceneView view;
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    view.instances.emplace_back();
    view.instances.back().node = static_cast<int>(i);
  }
  return view;
}

NodeOptions entry(std::variant<int, std::string> node) {
  NodeOptions options;
  options.node = std::move(node);
  return options;
}

TEST(ResolveNodes, D2_WithoutEntriesThereIsNothingToKeep) {
  const auto nodes = resolveNodes({}, town());
  ASSERT_TRUE(nodes);
  EXPECT_TRUE(nodes->empty());
}

TEST(ResolveNodes, D2_TheNearestEntryUpTheTreeWinsFieldByField) {
  NodeOptions above = entry("town");
  above.visible = false;
  above.layers = 4;
  NodeOptions below = entry("house");
  below.visible = true;
  below.receiveShadow = false;
  for (const auto& entries : {std::vector{above, below}, std::vector{below, above}}) {
    const auto nodes = resolveNodes(entries, town());
    ASSERT_TRUE(nodes);
    const NodeSwitches& lamp = (*nodes)[2];
    EXPECT_TRUE(lamp.visible) << "as the house";
    EXPECT_FALSE(lamp.receiveShadow) << "as the house";
    EXPECT_EQ(lamp.layers, 4) << "as the town";
    EXPECT_FALSE((*nodes)[0].visible);
    EXPECT_TRUE((*nodes)[0].receiveShadow) << "what is below says nothing of what is above";
    EXPECT_EQ((*nodes)[4].layers, 1);
  }
}

TEST(ResolveNodes, D2_OfTwoEntriesForOneNodeTheLaterCounts) {
  NodeOptions all = entry("lamp");
  all.visible = false;
  NodeOptions one = entry(3);
  one.visible = true;
  const auto nodes = resolveNodes(std::vector{all, one}, town());
  ASSERT_TRUE(nodes);
  EXPECT_FALSE((*nodes)[2].visible) << "a name goes for every node that has it";
  EXPECT_TRUE((*nodes)[3].visible);
  const auto turned = resolveNodes(std::vector{one, all}, town());
  ASSERT_TRUE(turned);
  EXPECT_FALSE((*turned)[3].visible);
}

TEST(ResolveNodes, D2_WhatIsNotSeenCastsOnlyWhenTold) {
  NodeOptions hidden = entry("house");
  hidden.visible = false;
  EXPECT_FALSE((*resolveNodes(std::vector{hidden}, town()))[2].castShadow);
  hidden.castShadow = true;
  EXPECT_TRUE((*resolveNodes(std::vector{hidden}, town()))[2].castShadow);
  NodeOptions shown = entry("lamp");
  shown.visible = true;
  hidden.castShadow.reset();
  EXPECT_TRUE((*resolveNodes(std::vector{hidden, shown}, town()))[2].castShadow) << "seen again, it casts again";
}

TEST(ResolveNodes, D2_ANodeThatIsNotThereIsNamedAndSoAreThoseThatAre) {
  const auto nodes = resolveNodes(std::vector{entry("lamp"), entry(5), entry("Lamp"), entry("")}, town());
  ASSERT_FALSE(nodes);
  ASSERT_EQ(nodes.problems().size(), 2u) << "nodes without a name have the empty one";
  EXPECT_EQ(nodes.problems()[0].pointer, "/nodes/1/node");
  EXPECT_EQ(nodes.problems()[0].limit, "0..4");
  EXPECT_EQ(nodes.problems()[0].actual, "5");
  EXPECT_EQ(nodes.problems()[1].pointer, "/nodes/2/node");
  EXPECT_EQ(nodes.problems()[1].limit, "one of town, house, lamp, lamp");
  EXPECT_EQ(nodes.problems()[1].actual, "Lamp");
}

TEST(ResolveNodes, D2_AChainOfAllNodesIsWalkedOnce) {
  Scene scene;
  const int count = static_cast<int>(kLimits.maxNodes);
  for (int i = 0; i < count; ++i) scene.nodes.push_back({"link", i + 1 < count ? i + 1 : -1});
  NodeOptions last = entry(count - 1);
  last.layers = 8;
  const auto nodes = resolveNodes(std::vector{last}, scene);
  ASSERT_TRUE(nodes);
  EXPECT_EQ(nodes->front().layers, 8);
}

TEST(ResolveNodes, X14_GroupsMatterOnlyWhereALightTellsThemApart) {
  const Scene scene = town();
  NodeOptions second = entry("house");
  second.layers = 2;
  const auto nodes = resolveNodes(std::vector{second}, scene);
  ASSERT_TRUE(nodes);
  Light sun;
  const auto alike = resolveReceiverGroups(scene, placing(scene), *nodes, std::vector{sun, sun});
  ASSERT_TRUE(alike);
  EXPECT_FALSE(alike->matter());
  Light lamp;
  lamp.cullingMask = 2;
  const auto apart = resolveReceiverGroups(scene, placing(scene), *nodes, std::vector{sun, lamp});
  ASSERT_TRUE(apart);
  EXPECT_TRUE(apart->matter());
  EXPECT_EQ(apart->ofLight[0], LitGroups{});
  const auto lit = [&](std::size_t node) { return (apart->ofLight[1].lit >> apart->ofInstance[node] & 1u) != 0; };
  EXPECT_FALSE(lit(0));
  EXPECT_TRUE(lit(1));
  EXPECT_TRUE(lit(2));
  EXPECT_FALSE(lit(4));
  EXPECT_TRUE(resolveReceiverGroups(scene, placing(scene), {}, std::vector{lamp})->matter())
      << "all nodes are of layer 1";
}

TEST(ResolveNodes, D2_WhatReceivesNoShadowIsToldFromTheRest) {
  const Scene scene = town();
  SceneView view = placing(scene);
  view.instances[3].material = 1; // unlit
  NodeOptions plain = entry("house");
  plain.receiveShadow = false;
  NodeOptions apart = entry("");
  apart.layers = 2;
  const auto nodes = resolveNodes(std::vector{plain, apart}, scene);
  ASSERT_TRUE(nodes);
  Light sun;
  sun.cullingMask = 1;
  const auto groups = resolveReceiverGroups(scene, view, *nodes, std::vector{sun});
  ASSERT_TRUE(groups);
  const bool expected[] = {true, false, false, false, false};
  for (std::size_t i = 0; i < view.instances.size(); ++i) {
    const int material = materialOf(scene, view.instances[i]);
    EXPECT_EQ((groups->ofLight[0].shadowed >> groups->ofInstance[i] & 1u) != 0, expected[i]) << i;
    EXPECT_EQ(receivesFrom(sun, (*nodes)[i], scene.materials[static_cast<std::size_t>(material)]), expected[i]) << i;
  }
}

TEST(ResolveNodes, D2_WhatIsUnlitReceivesNothingWithoutAnyEntryForItsNode) {
  const Scene scene = town();
  SceneView view = placing(scene);
  EXPECT_TRUE(resolveReceiverGroups(scene, view, {}, std::vector{Light{}})->ofInstance.empty());
  view.instances[2].material = 1;
  const auto groups = resolveReceiverGroups(scene, view, {}, std::vector{Light{}});
  ASSERT_TRUE(groups);
  EXPECT_NE(groups->ofInstance[2], groups->ofInstance[1]);
  EXPECT_EQ(groups->ofLight[0].lit >> groups->ofInstance[2] & 1u, 1u) << "lights still reach it";
  EXPECT_EQ(groups->ofLight[0].shadowed >> groups->ofInstance[2] & 1u, 0u);
  EXPECT_EQ(layersInUse(scene, view, {}).receiving, 1);
  for (Instance& instance : view.instances) instance.material = 1;
  EXPECT_EQ(layersInUse(scene, view, {}).receiving, 0);
  EXPECT_EQ(layersInUse(scene, view, {}).casting, 1);
}

TEST(ResolveNodes, X14_MoreGroupsThanAFrameTellsApartAreAProblem) {
  Scene scene = town();
  scene.nodes.clear();
  std::vector<NodeOptions> entries;
  for (int i = 0; i <= kLimits.maxReceiverGroups; ++i) {
    scene.nodes.push_back({"", -1});
    entries.push_back(entry(i));
    entries.back().layers = i + 1;
  }
  const SceneView view = placing(scene);
  const auto tooMany = resolveReceiverGroups(scene, view, *resolveNodes(entries, scene), {});
  ASSERT_FALSE(tooMany);
  EXPECT_EQ(tooMany.problems()[0].pointer, "/nodes");
  EXPECT_EQ(tooMany.problems()[0].limit, "32");
  EXPECT_EQ(tooMany.problems()[0].actual, "33");
  entries.back().visible = false;
  EXPECT_TRUE(resolveReceiverGroups(scene, view, *resolveNodes(entries, scene), {}))
      << "what isn't seen receives nothing";
}

} // namespace
} // namespace gnomon
