#include "renderer/scene/geometry/welding.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace gnomon {
namespace {

struct Shape {
  std::vector<glm::vec3> positions;
  std::vector<std::uint32_t> indices;

  bool solid() const { return boundsSolids(weldedIndices(indices, positions), positions); }
};

/// A cube whose faces share no vertices, as exporters write hard edges; front faces outside.
Shape cube(const glm::vec3& center, float half) {
  Shape shape;
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {-1.0f, 1.0f}) {
      const auto first = static_cast<std::uint32_t>(shape.positions.size());
      for (const glm::vec2& corner : {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1), glm::vec2(-1, 1)}) {
        glm::vec3 p;
        p[axis] = side;
        p[(axis + 1) % 3] = corner.x * side; // seen from outside, the corners go round against the clock
        p[(axis + 2) % 3] = corner.y;
        shape.positions.push_back(center + p * half);
      }
      for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) shape.indices.push_back(first + i);
    }
  }
  return shape;
}

Shape both(Shape a, const Shape& b) {
  const auto first = static_cast<std::uint32_t>(a.positions.size());
  a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
  for (const std::uint32_t i : b.indices) a.indices.push_back(first + i);
  return a;
}

Shape turnedInsideOut(Shape shape) {
  for (std::size_t t = 0; t < shape.indices.size(); t += 3) std::swap(shape.indices[t], shape.indices[t + 1]);
  return shape;
}

TEST(Welding, VerticesAtOnePlaceBecomeOne) {
  const Shape shape = cube({0, 0, 0}, 1);
  std::vector<std::uint32_t> welded = weldedIndices(shape.indices, shape.positions);
  for (std::size_t i = 0; i < welded.size(); ++i) {
    EXPECT_EQ(shape.positions[welded[i]], shape.positions[shape.indices[i]]);
  }
  std::sort(welded.begin(), welded.end());
  EXPECT_EQ(std::unique(welded.begin(), welded.end()) - welded.begin(), 8);
}

TEST(Welding, OnlyWhatIsClosedIsSolid) {
  Shape shape = cube({0, 0, 0}, 1);
  EXPECT_TRUE(shape.solid());
  shape.indices.resize(shape.indices.size() - 3);
  EXPECT_FALSE(shape.solid()) << "a triangle is missing";
  EXPECT_FALSE(Shape{}.solid());
}

TEST(Welding, FacesThatLookInwardsAreNoSolid) {
  EXPECT_FALSE(turnedInsideOut(cube({0, 0, 0}, 1)).solid());
  EXPECT_FALSE(both(cube({0, 0, 0}, 9), turnedInsideOut(cube({40, 0, 0}, 1))).solid()) << "one piece of two";
}

TEST(Welding, PiecesMayTouchOverlapAndLieFarAway) {
  EXPECT_TRUE(both(cube({0, 0, 0}, 1), cube({2, 2, 0}, 1)).solid()) << "an edge of four faces";
  EXPECT_TRUE(both(cube({0, 0, 0}, 1), cube({0.5f, 0.25f, 0}, 1)).solid());
  EXPECT_TRUE(cube({1e6f, -1e6f, 1e6f}, 1).solid());
}

TEST(Welding, ATriangleWithTwoCornersAtOnePlaceOpensNothing) {
  Shape shape = cube({0, 0, 0}, 1);
  shape.indices.insert(shape.indices.end(), {0, 0, 1});
  EXPECT_TRUE(shape.solid());
}

} // namespace
} // namespace gnomon
