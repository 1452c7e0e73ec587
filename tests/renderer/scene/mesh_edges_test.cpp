#include <algorithm>
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <set>

#include "renderer/scene/geometry/welding.h"
#include "tests/renderer/scene/load.h"

namespace gnomon {
namespace {

/// A scene of one primitive whose vertices are at as many places.
Scene meshOf(const std::vector<std::uint32_t>& welded, std::uint32_t firstIndex = 0) {
  Scene scene;
  std::vector<std::uint32_t>& all = scene.welded.edit();
  all.assign(firstIndex, 0);
  all.insert(all.end(), welded.begin(), welded.end());
  Primitive primitive;
  primitive.firstIndex = firstIndex;
  primitive.indexCount = static_cast<std::uint32_t>(welded.size());
  primitive.vertexCount = welded.empty() ? 0 : *std::max_element(welded.begin(), welded.end()) + 1;
  scene.primitives.push_back(primitive);
  return scene;
}

std::vector<MeshEdge> edgesOf(const std::vector<std::uint32_t>& welded) {
  const Scene scene = meshOf(welded);
  return meshEdges(scene, scene.primitives.front());
}

std::size_t openEdges(const std::vector<MeshEdge>& edges) {
  return static_cast<std::size_t>(
      std::count_if(edges.begin(), edges.end(), [](const MeshEdge& edge) { return edge.right == kNoTriangle; }));
}

bool runs(const std::vector<std::uint32_t>& welded, std::uint32_t triangle, std::uint32_t from, std::uint32_t to) {
  for (std::size_t corner = 0; corner < 3; ++corner) {
    const std::size_t first = std::size_t{3} * triangle;
    if (welded[first + corner] == from && welded[first + (corner + 1) % 3] == to) return true;
  }
  return false;
}

const std::vector<std::uint32_t> kTetrahedron = {0, 1, 2, 0, 3, 1, 1, 3, 2, 2, 3, 0};

TEST(MeshEdges, AClosedMeshHasEachEdgeOnceAndNoneOpen) {
  const auto edges = edgesOf(kTetrahedron);
  EXPECT_EQ(edges.size(), 6u);
  EXPECT_EQ(openEdges(edges), 0u);
}

TEST(MeshEdges, FacesThatShareNoVerticesButPlacesAreNeighbours) {
  const Scene scene = load(testing::cube());
  const auto edges = meshEdges(scene, scene.primitives.front());
  EXPECT_EQ(edges.size(), 18u) << "12 of the cube and a diagonal a face";
  EXPECT_EQ(openEdges(edges), 0u);
}

TEST(MeshEdges, AnEdgeKeepsTheWayItsTrianglesRun) {
  EXPECT_TRUE(rc::check([] {
    const auto triangles = *rc::gen::inRange<std::size_t>(0, 40);
    const auto welded =
        *rc::gen::container<std::vector<std::uint32_t>>(3 * triangles, rc::gen::inRange<std::uint32_t>(0, 8));
    std::multiset<std::pair<std::uint32_t, std::uint32_t>> found;
    std::multiset<std::pair<std::uint32_t, std::uint32_t>> alone;
    for (const MeshEdge& edge : edgesOf(welded)) {
      RC_ASSERT(runs(welded, edge.left, edge.from, edge.to));
      found.emplace(edge.from, edge.to);
      if (edge.right == kNoTriangle) {
        alone.emplace(edge.from, edge.to);
        continue;
      }
      RC_ASSERT(runs(welded, edge.right, edge.to, edge.from));
      found.emplace(edge.to, edge.from);
    }
    std::multiset<std::pair<std::uint32_t, std::uint32_t>> expected;
    for (std::size_t t = 0; t < triangles; ++t) {
      const std::uint32_t a = welded[3 * t];
      const std::uint32_t b = welded[3 * t + 1];
      const std::uint32_t c = welded[3 * t + 2];
      if (a == b || b == c || c == a) continue;
      expected.insert({{a, b}, {b, c}, {c, a}});
    }
    RC_ASSERT(found == expected);
    for (const auto& [from, to] : alone) RC_ASSERT(alone.count({to, from}) == 0u);
  }));
}

TEST(MeshEdges, AFanIsOpenAroundItsRim) {
  const auto edges = edgesOf({0, 1, 2, 0, 2, 3, 0, 3, 4});
  EXPECT_EQ(edges.size(), 7u);
  EXPECT_EQ(openEdges(edges), 5u) << "three on the rim, and both ends";
}

TEST(MeshEdges, WhereABandIsTwistedItsTwoSidesAreNoPair) {
  // Six triangles that run around a Moebius band of three quads: where its ends meet, both run the same way.
  const auto edges = edgesOf({0, 2, 1, 1, 2, 3, 2, 4, 3, 3, 4, 5, 4, 1, 5, 5, 1, 0});
  EXPECT_EQ(openEdges(edges), 6u + 2u) << "the rim, and the two sides of the seam";
}

TEST(MeshEdges, ATriangleThatIsThereTwiceHasItsEdgesTwice) {
  EXPECT_EQ(openEdges(edgesOf({0, 1, 2, 0, 1, 2})), 6u);
  const auto backToBack = edgesOf({0, 1, 2, 2, 1, 0});
  EXPECT_EQ(backToBack.size(), 3u);
  EXPECT_EQ(openEdges(backToBack), 0u);
}

TEST(MeshEdges, OfThreeTrianglesAtAnEdgeTwoAreAPairIfTheyRunOppositeWays) {
  const auto edges = edgesOf({0, 1, 2, 1, 0, 3, 0, 1, 4});
  EXPECT_EQ(edges.size(), 2u + 6u);
  EXPECT_EQ(openEdges(edges), 1u + 6u);
}

TEST(MeshEdges, TwoSolidsThatTouchAlongAnEdgeStayClosed) {
  std::vector<std::uint32_t> welded = kTetrahedron;
  for (const std::uint32_t i : kTetrahedron) welded.push_back(i < 2 ? i : i + 2);
  const auto edges = edgesOf(welded);
  EXPECT_EQ(edges.size(), 12u);
  EXPECT_EQ(openEdges(edges), 0u);
}

TEST(MeshEdges, TrianglesWithTwoCornersAtOnePlaceHaveNone) {
  EXPECT_TRUE(edgesOf({0, 0, 1, 2, 1, 2, 3, 3, 3}).empty());
  EXPECT_TRUE(edgesOf({}).empty());
}

TEST(MeshEdges, APrimitiveIsReadAtItsOwnPlace) {
  const Scene scene = meshOf(kTetrahedron, 6);
  EXPECT_EQ(meshEdges(scene, scene.primitives.front()).size(), 6u);
}

TEST(MeshEdges, AMillionTrianglesAreSortedNotSearched) {
  // A torus of 1000 x 500 quads. Anything that looks through all triangles for each would take hours.
  constexpr std::uint32_t kColumns = 1000;
  constexpr std::uint32_t kRows = 500;
  std::vector<std::uint32_t> welded;
  welded.reserve(std::size_t{6} * kColumns * kRows);
  for (std::uint32_t y = 0; y < kRows; ++y) {
    for (std::uint32_t x = 0; x < kColumns; ++x) {
      const std::uint32_t right = (x + 1) % kColumns;
      const std::uint32_t up = (y + 1) % kRows;
      const std::uint32_t corners[] = {y * kColumns + x, y * kColumns + right, up * kColumns + right,
                                       up * kColumns + x};
      for (const int i : {0, 1, 2, 0, 2, 3}) welded.push_back(corners[i]);
    }
  }
  const auto edges = edgesOf(welded);
  EXPECT_EQ(edges.size(), welded.size() / 2);
  EXPECT_EQ(openEdges(edges), 0u);
}

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
