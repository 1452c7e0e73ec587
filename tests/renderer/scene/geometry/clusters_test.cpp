#include <algorithm>
#include <array>
#include <gtest/gtest.h>
#include <meshoptimizer.h>
#include <numeric>
#include <random>
#include <rapidcheck.h>

#include "renderer/scene/geometry/mesh_build.h"
#include "tests/renderer/scene/load.h"
#include "tests/support/compressed_models.h"

namespace gnomon {
namespace {

struct Soup {
  std::vector<glm::vec3> positions;
  std::vector<std::uint32_t> indices;
};

/// Small triangles, strewn over a 100 m cube.
Soup strewnTriangles(std::size_t count, unsigned seed) {
  Soup soup;
  std::uint32_t state = seed * 2654435761u + 1;
  const auto next = [&] {
    state = state * 1664525u + 1013904223u;
    return static_cast<float>(state >> 8) / 16777216.0f;
  };
  for (std::size_t t = 0; t < count; ++t) {
    const glm::vec3 center(100 * next(), 100 * next(), 100 * next());
    for (int corner = 0; corner < 3; ++corner) {
      soup.indices.push_back(static_cast<std::uint32_t>(soup.positions.size()));
      soup.positions.push_back(center + glm::vec3(next(), next(), next()));
    }
  }
  return soup;
}

std::vector<std::array<std::uint32_t, 3>> triangleSet(const std::vector<std::uint32_t>& indices) {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::size_t i = 0; i < indices.size(); i += 3) {
    triangles.push_back({indices[i], indices[i + 1], indices[i + 2]});
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

TEST(Clusters, SortingKeepsTheTrianglesAndTheirWinding) {
  EXPECT_TRUE(rc::check([] {
    const Soup soup = strewnTriangles(*rc::gen::inRange<std::size_t>(0, 5000), *rc::gen::arbitrary<unsigned>());
    const auto sorted = spatiallySorted(soup.indices, soup.positions);
    RC_ASSERT(triangleSet(sorted) == triangleSet(soup.indices));
    RC_ASSERT(sorted == spatiallySorted(soup.indices, soup.positions));
  }));
}

TEST(Clusters, CoverEveryTriangleInOrder) {
  EXPECT_TRUE(rc::check([] {
    const Soup soup = strewnTriangles(*rc::gen::inRange<std::size_t>(0, 5000), 1);
    const auto clusters = clustersOf(soup.indices, soup.positions);
    const std::size_t triangles = soup.indices.size() / 3;
    RC_ASSERT(clusters.size() == (triangles + kClusterTriangles - 1) / kClusterTriangles);
    for (std::size_t i = 0; i < soup.indices.size(); ++i) {
      const Aabb& box = clusters[i / 3 / kClusterTriangles].bounds;
      const glm::dvec3 p(soup.positions[soup.indices[i]]);
      RC_ASSERT(glm::all(glm::lessThanEqual(box.min, p)) && glm::all(glm::greaterThanEqual(box.max, p)));
    }
  }));
}

TEST(Clusters, AreSmallerThanTheWhole) {
  const Soup soup = strewnTriangles(std::size_t{64} * kClusterTriangles, 7);
  double volume = 0;
  for (const Cluster& cluster : clustersOf(spatiallySorted(soup.indices, soup.positions), soup.positions)) {
    const glm::dvec3 size = 2.0 * cluster.bounds.halfExtent();
    volume += size.x * size.y * size.z;
  }
  EXPECT_LT(volume / 64, 0.1 * 100 * 100 * 100) << "mean volume of the 64 clusters";
}

TEST(Clusters, BelongToTheirPrimitive) {
  const Soup soup = strewnTriangles(2500, 3);
  std::vector<testing::Point> points;
  for (const glm::vec3& p : soup.positions) points.push_back({p.x, p.y, p.z});
  testing::GlbBuilder builder = testing::cube();
  builder.addMeshNode(builder.addMesh({{"attributes", {{"POSITION", builder.addPoints(points)}}}}));
  const Scene scene = load(builder);
  ASSERT_EQ(scene.primitives.size(), 2u);
  EXPECT_EQ(scene.primitives[1].firstCluster, 1u);
  EXPECT_EQ(scene.primitives[1].clusterCount, 3u);
  EXPECT_EQ(scene.clusters.size(), 4u);
  EXPECT_EQ(scene.primitives[1].firstIndex, 36u);
  EXPECT_EQ(scene.primitives[1].baseVertex, 24u);
  EXPECT_EQ(load(builder).indices, scene.indices);
}

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
