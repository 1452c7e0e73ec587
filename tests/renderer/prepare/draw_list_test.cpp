#include "renderer/prepare/draw_list.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <rapidcheck.h>

namespace gnomon {
namespace {

/// Primitives of `clusters` full clusters and one of a single triangle, each placed once.
struct Placed {
  Scene scene;
  SceneView view;
};

void addPrimitive(Placed& placed, int material, std::uint32_t fullClusters, const glm::dmat4& worldFromLocal) {
  Primitive primitive;
  primitive.material = material;
  primitive.firstIndex = static_cast<std::uint32_t>(placed.scene.indices.size());
  primitive.indexCount = fullClusters * kClusterTriangles * 3 + 3;
  primitive.firstCluster = static_cast<std::uint32_t>(placed.scene.clusters.size());
  primitive.clusterCount = fullClusters + 1;
  placed.scene.indices.edit().resize(placed.scene.indices.size() + primitive.indexCount);
  for (std::uint32_t i = 0; i < primitive.clusterCount; ++i) {
    placed.scene.clusters.push_back({{glm::dvec3(i), glm::dvec3(i + 1.0)}});
  }
  Instance instance;
  instance.primitive = static_cast<int>(placed.scene.primitives.size());
  instance.worldFromLocal = worldFromLocal;
  placed.scene.primitives.push_back(primitive);
  placed.view.instances.push_back(instance);
}

Placed threePrimitives() {
  Placed placed;
  placed.scene.materials.resize(3);
  placed.scene.materials[1].cutoff = 0.5f;
  placed.scene.materials[2].doubleSided = true;
  addPrimitive(placed, 0, 4, glm::dmat4(1));
  addPrimitive(placed, 1, 2, glm::scale(glm::dmat4(1), glm::dvec3(-1, 1, 1)));
  addPrimitive(placed, 2, 3, glm::dmat4(1));
  return placed;
}

TEST(DrawList, HoldsExactlyTheTrianglesOfTheSlotsThatAreKept) {
  const Placed placed = threePrimitives();
  const FrameGeometry geometry = frameGeometry(placed.scene, placed.view, glm::dvec3(0));
  EXPECT_TRUE(rc::check([&] {
    const auto keep = *rc::gen::container<std::vector<std::uint8_t>>(
        geometry.slotCount(), rc::gen::map(rc::gen::arbitrary<bool>(), [](bool b) { return std::uint8_t{b}; }));
    std::uint64_t expected = 0;
    for (std::size_t i = 0; i < placed.view.instances.size(); ++i) {
      const Primitive& primitive = placed.scene.primitives[i];
      for (std::uint32_t c = 0; c < primitive.clusterCount; ++c) {
        const bool last = c + 1 == primitive.clusterCount;
        if (keep[geometry.firstSlot[i] + c] != 0) expected += last ? 1 : kClusterTriangles;
      }
    }
    for (const DrawUse use : {DrawUse::survey, DrawUse::cast, DrawUse::surface}) {
      const DrawList list = buildDrawList(placed.scene, placed.view, geometry, use, keep);
      RC_ASSERT(list.triangles == expected);
      std::size_t grouped = 0;
      std::uint64_t drawn = 0;
      for (const DrawGroup& group : list.groups) {
        RC_ASSERT(group.firstRange == grouped);
        grouped += group.rangeCount;
      }
      for (const DrawRange& range : list.ranges) drawn += range.indexCount / 3;
      RC_ASSERT(grouped == list.ranges.size());
      RC_ASSERT(drawn == expected);
    }
  }));
}

DrawList listOf(DrawUse use) {
  const Placed placed = threePrimitives();
  const FrameGeometry geometry = frameGeometry(placed.scene, placed.view, glm::dvec3(0));
  const std::vector<std::uint8_t> all(geometry.slotCount(), 1);
  return buildDrawList(placed.scene, placed.view, geometry, use, all);
}

TEST(DrawList, NeighbouringClustersAreOneDraw) {
  EXPECT_EQ(listOf(DrawUse::cast).ranges.size(), 3u);
}

TEST(DrawList, G2_MaskedMaterialsGetAGroupOfTheirOwnEvenWhenTheyCast) {
  const DrawList list = listOf(DrawUse::cast);
  ASSERT_EQ(list.groups.size(), 2u);
  EXPECT_EQ(list.groups[0].material, -1);
  EXPECT_EQ(list.groups[1].material, 1);
}

TEST(DrawList, X34_CastersAreNotCulledByFacing) {
  for (const DrawGroup& group : listOf(DrawUse::cast).groups) {
    EXPECT_EQ(group.facing, Facing::both);
  }
}

TEST(DrawList, G4_AMirroredNodeTurnsItsFrontFace) {
  const DrawList list = listOf(DrawUse::surface);
  ASSERT_EQ(list.groups.size(), 3u);
  EXPECT_EQ(list.groups[0].facing, Facing::counterClockwise);
  EXPECT_EQ(list.groups[1].facing, Facing::clockwise);
  EXPECT_EQ(list.groups[2].facing, Facing::both) << "double-sided";
}

} // namespace
} // namespace gnomon
