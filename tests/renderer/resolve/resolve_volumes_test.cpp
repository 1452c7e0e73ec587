#include <gtest/gtest.h>

#include "renderer/resolve/resolve_nodes.h"

namespace gnomon {
namespace {

/// Of a view: "cart" 0, which holds "load" 1, and two "wheel" 2, 3; "shed" 4 is in another.
struct Yard {
  Yard() {
    scene.nodes = {{"cart", -1}, {"load", 0}, {"wheel", 0}, {"wheel", 0}, {"shed", -1}};
    scene.placedNodes.resize(5);
    scene.placedNodes[1].worldFromNode[3] = {4, 5, 6, 1};
    view.roots = {0};
  }

  Scene scene;
  SceneView view;
};

VolumeOptions at(std::variant<int, std::string> node) {
  VolumeOptions volume;
  volume.node = std::move(node);
  return volume;
}

VolumePlace placeOf(const Yard& yard, const VolumeOptions& volume, std::span<const NodeSwitches> nodes = {}) {
  const auto places = resolveVolumes({&volume, 1}, yard.scene, yard.view, nodes);
  EXPECT_TRUE(places);
  return places ? places->at(0) : VolumePlace{};
}

TEST(ResolveVolumes, ANodeIsFoundByIndexOrName) {
  const Yard yard;
  EXPECT_EQ(placeOf(yard, VolumeOptions{}), VolumePlace{});
  const VolumePlace byName = placeOf(yard, at("load"));
  EXPECT_EQ(byName, placeOf(yard, at(1)));
  EXPECT_EQ(byName.worldFromNode, yard.scene.placedNodes[1].worldFromNode);
  EXPECT_FALSE(byName.hidden());
}

TEST(ResolveVolumes, D2_ItTakesPartAsTheSwitchesOfItsNodeSay) {
  const Yard yard;
  std::vector<NodeSwitches> nodes(5);
  nodes[1] = {.visible = false, .castShadow = true, .receiveShadow = false};
  const VolumePlace unseen = placeOf(yard, at(1), nodes);
  EXPECT_FALSE(unseen.visible);
  EXPECT_TRUE(unseen.castShadow);
  EXPECT_FALSE(unseen.receiveShadow);
  EXPECT_FALSE(unseen.hidden());
  nodes[1].castShadow = false;
  EXPECT_TRUE(placeOf(yard, at(1), nodes).hidden());
}

TEST(ResolveVolumes, WhatAPoseHidesOrFlattensIsHidden) {
  Yard yard;
  yard.scene.placedNodes[1].hidden = true;
  EXPECT_TRUE(placeOf(yard, at(1)).hidden());
  yard.scene.placedNodes[2].worldFromNode = glm::dmat4(0);
  EXPECT_TRUE(placeOf(yard, at(2)).hidden());
}

TEST(ResolveVolumes, ANodeThatIsNotThereIsNamed) {
  const Yard yard;
  const std::vector<VolumeOptions> volumes{at("load"), at("hay"), at(5), at("wheel"), at(4), at("shed")};
  const auto places = resolveVolumes(volumes, yard.scene, yard.view, {});
  ASSERT_FALSE(places);
  const Problems& problems = places.problems();
  ASSERT_EQ(problems.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(problems[i].pointer, "/volumes/" + std::to_string(i + 1) + "/node");
  EXPECT_EQ(problems[0].limit, "one of cart, load, wheel, wheel, shed");
  EXPECT_EQ(problems[1].limit, "0..4");
  EXPECT_EQ(problems[2].limit, "2 | 3");
}

} // namespace
} // namespace gnomon
