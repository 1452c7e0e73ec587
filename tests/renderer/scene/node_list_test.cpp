#include "renderer/scene/node_list.h"

#include "tests/renderer/scene/load.h"

namespace gnomon {
namespace {

/// A cube at node 0, and a node below it with the same mesh.
testing::GlbBuilder cubeOnCube() {
  testing::GlbBuilder builder = testing::cube();
  builder.json["nodes"][0]["name"] = "base";
  builder.json["nodes"][0]["children"] = {1};
  builder.add("nodes", {{"name", "top"}, {"mesh", 0}, {"translation", {0, 1, 0}}});
  return builder;
}

TEST(NodeList, NamesParentsAndTriangles) {
  const NodeList list = nodesOf(load(cubeOnCube()), {});
  ASSERT_EQ(list.nodes.size(), 2u);
  EXPECT_FALSE(list.next);
  EXPECT_EQ(list.nodes[0].name, "base");
  EXPECT_FALSE(list.nodes[0].parent);
  EXPECT_EQ(list.nodes[0].triangles, 12u);
  EXPECT_EQ(list.nodes[1].node, 1);
  EXPECT_EQ(list.nodes[1].parent, 0);
  EXPECT_EQ(list.nodes[1].triangles, 12u);
}

TEST(NodeList, PagesHaveEveryNodeOnce) {
  const Scene& scene = load(cubeOnCube());
  const NodeList first = nodesOf(scene, {.limit = 1});
  ASSERT_EQ(first.nodes.size(), 1u);
  ASSERT_EQ(first.next, 0);
  const NodeList second = nodesOf(scene, {.after = *first.next, .limit = 1});
  ASSERT_EQ(second.nodes.size(), 1u);
  EXPECT_EQ(second.nodes[0].node, 1);
  EXPECT_FALSE(second.next);
  EXPECT_TRUE(nodesOf(scene, {.after = 99'999}).nodes.empty());
}

TEST(NodeList, APageWithLongNamesEndsEarly) {
  testing::GlbBuilder builder = cubeOnCube();
  builder.json["nodes"][0]["name"] = std::string(5 << 20, 'n');
  const NodeList list = nodesOf(load(builder), {});
  EXPECT_EQ(list.nodes.size(), 1u);
  EXPECT_EQ(list.next, 0);
}

} // namespace
} // namespace gnomon
