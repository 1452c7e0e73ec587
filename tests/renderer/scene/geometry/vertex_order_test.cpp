#include <algorithm>
#include <array>
#include <gtest/gtest.h>
#include <meshoptimizer.h>
#include <numeric>
#include <random>

#include "renderer/scene/geometry/mesh_build.h"
#include "tests/support/compressed_models.h"

namespace gnomon {
namespace {

/// A torus whose triangles and vertices stand in no order.
TriangleMesh shuffled(int segments) {
  const testing::Shape shape = testing::torus(segments);
  std::mt19937 random(7);
  std::vector<std::uint32_t> place(shape.positions.size());
  std::iota(place.begin(), place.end(), 0u);
  std::shuffle(place.begin(), place.end(), random);
  TriangleMesh mesh;
  mesh.positions.resize(place.size());
  mesh.attributes.resize(place.size());
  mesh.sources.resize(place.size());
  for (std::uint32_t i = 0; i < place.size(); ++i) {
    mesh.positions[place[i]] = shape.positions[i];
    mesh.attributes[place[i]].uv0 = shape.texCoords[i];
    mesh.sources[place[i]] = i;
  }
  std::vector<std::uint32_t> triangles(shape.indices.size() / 3);
  std::iota(triangles.begin(), triangles.end(), 0u);
  std::shuffle(triangles.begin(), triangles.end(), random);
  for (const std::uint32_t triangle : triangles) {
    for (std::uint32_t corner = 0; corner < 3; ++corner) {
      mesh.indices.push_back(place[shape.indices[3 * triangle + corner]]);
    }
  }
  return mesh;
}

/// The triangles as corners of the source, each beginning with its least, sorted.
std::vector<std::array<std::uint32_t, 3>> trianglesOf(const TriangleMesh& mesh, std::size_t first, std::size_t last) {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::size_t i = first; i < last; i += 3) {
    std::array<std::uint32_t, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) corners[k] = mesh.sources[mesh.indices[i + k]];
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    triangles.push_back(corners);
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

float missesPerTriangle(const TriangleMesh& mesh) {
  return meshopt_analyzeVertexCache(mesh.indices.data(), mesh.indices.size(), mesh.positions.size(), 16, 0, 0).acmr;
}

TEST(VertexOrder, KeepsEveryTriangleAndVertex) {
  const TriangleMesh before = shuffled(60);
  const TriangleMesh after = ordered(before);
  EXPECT_EQ(trianglesOf(after, 0, after.indices.size()), trianglesOf(before, 0, before.indices.size()));
  const testing::Shape shape = testing::torus(60);
  ASSERT_EQ(after.positions.size(), shape.positions.size());
  for (std::size_t i = 0; i < after.positions.size(); ++i) {
    EXPECT_EQ(after.positions[i], shape.positions[after.sources[i]]);
    EXPECT_EQ(after.attributes[i].uv0, shape.texCoords[after.sources[i]]);
  }
  EXPECT_EQ(ordered(before).indices, after.indices);
  EXPECT_TRUE(ordered(TriangleMesh{}).indices.empty());
}

TEST(VertexOrder, ClustersHoldTheTrianglesThatLieTogether) {
  TriangleMesh sorted = shuffled(60);
  sorted.indices = spatiallySorted(std::move(sorted.indices), sorted.positions);
  const TriangleMesh after = ordered(shuffled(60));
  constexpr std::size_t kCorners = std::size_t{3} * kClusterTriangles;
  ASSERT_GT(after.indices.size(), 3 * kCorners);
  for (std::size_t first = 0; first < after.indices.size(); first += kCorners) {
    const std::size_t last = std::min(first + kCorners, after.indices.size());
    EXPECT_EQ(trianglesOf(after, first, last), trianglesOf(sorted, first, last));
  }
}

TEST(VertexOrder, VerticesAreUsedAgainWhileTheyAreNear) {
  const TriangleMesh before = shuffled(60);
  const TriangleMesh after = ordered(before);
  EXPECT_GT(missesPerTriangle(before), 2.5f);
  EXPECT_LT(missesPerTriangle(after), 0.85f);
  std::uint32_t next = 0;
  for (const std::uint32_t index : after.indices) {
    EXPECT_LE(index, next) << "first uses ascend";
    next = std::max(next, index + 1);
  }
}

} // namespace
} // namespace gnomon
