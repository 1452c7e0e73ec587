#include <gtest/gtest.h>

#include "renderer/prepare/draw_list.h"

namespace gnomon {
namespace {

/// One primitive that begins at index 300, placed twice.
struct Placed {
  Scene scene;
  SceneView view;
};

Placed placedTwice() {
  Placed placed;
  Primitive primitive;
  primitive.firstIndex = 300;
  primitive.indexCount = 3 * 5000;
  placed.scene.primitives = {primitive};
  placed.view.instances.resize(2);
  return placed;
}

TEST(TriangleNumbers, RunThroughTheDrawsInTheirOrder) {
  const Placed placed = placedTwice();
  DrawList list;
  list.ranges = {{3 * 1024, 1, 300 + 3 * 2048, 0, 1}, {3 * 10, 1, 300, 0, 0}, {3 * 7, 1, 300 + 3 * 1024, 0, 1}};
  const TriangleNumbers numbers(placed.scene, placed.view, list);
  const std::vector<std::uint32_t> asked{0, 1023, 1024, 1033, 1034, 1040, 5, kNoNumber};
  const std::vector<PlacedTriangle> found = numbers.of(asked);
  const std::vector<PlacedTriangle> expected{{1, 2048}, {1, 3071}, {0, 0},    {0, 9},
                                             {1, 1024}, {1, 1030}, {1, 2053}, {kNoSurface, 0}};
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].instance, expected[i].instance) << i;
    EXPECT_EQ(found[i].triangle, expected[i].triangle) << i;
  }
}

} // namespace
} // namespace gnomon
