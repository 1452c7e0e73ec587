#include "renderer/bake/mapped_mesh.h"

#include <gtest/gtest.h>

#include "tests/renderer/rays/shapes.h"

namespace gnomon {
namespace {

using testing::GlbBuilder;

/// Two triangles that share two of four vertices.
void addSmoothSquare(GlbBuilder& builder) {
  const int positions = builder.addPoints({{-4, 0, 4}, {4, 0, 4}, {4, 0, -4}, {-4, 0, -4}});
  const int normals = builder.addPoints({{0, 1, 0}, {0, 1, 0}, {0, 1, 0}, {0, 1, 0}});
  builder.addMeshNode(builder.addMesh({{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}},
                                       {"indices", builder.addIndices({0, 1, 2, 0, 2, 3})}}));
}

TEST(MappedMesh, N5_EachCornerKeepsItsVertexAndItsPlace) {
  GlbBuilder builder;
  addSmoothSquare(builder);
  testing::addSphere(builder, {0, 2, 0}, 1, 24);
  const Scene scene = load(builder);
  const SceneView& view = scene.scenes[0];
  const auto layout = lightMapLayout(scene, view, {16.0, {}});
  ASSERT_TRUE(layout);
  for (std::size_t i = 0; i < view.instances.size(); ++i) {
    const Primitive& primitive = scene.primitives[static_cast<std::size_t>(view.instances[i].primitive)];
    const MappedMesh mesh = mappedMesh(scene, primitive, *layout, layout->firstCorner[i]);
    ASSERT_EQ(mesh.indices.size(), primitive.indexCount);
    if (i == 0) {
      EXPECT_EQ(mesh.vertices.size(), 4u) << "neighbours of one chart share vertices";
    }
    for (std::uint32_t c = 0; c < primitive.indexCount; ++c) {
      const MappedVertex& vertex = mesh.vertices.at(mesh.indices[c]);
      EXPECT_EQ(vertex.vertex, primitive.baseVertex + scene.indices[primitive.firstIndex + c]);
      EXPECT_EQ(vertex.corner, layout->corners[layout->firstCorner[i] + c]);
    }
  }
}

} // namespace
} // namespace gnomon
