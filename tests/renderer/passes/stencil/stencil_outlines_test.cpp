#include "renderer/passes/stencil/stencil_outlines.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "tests/renderer/scene/load.h"

namespace gnomon {
namespace {

std::vector<std::int8_t> facingsOf(const Scene& scene, const glm::dmat4& matrix, const glm::dvec4& light) {
  return facings(scene, scene.primitives.front(), matrix, light);
}

std::vector<SilhouetteEdge> outlineOf(const Scene& scene, const std::vector<std::int8_t>& turns) {
  return silhouette(meshEdges(scene, scene.primitives.front()), turns);
}

std::vector<std::int8_t> only(std::vector<std::int8_t> signs, std::int8_t wanted) {
  for (std::int8_t& sign : signs) {
    if (sign != wanted) sign = 0;
  }
  return signs;
}

glm::dvec3 positionOf(const Scene& scene, std::uint32_t vertex) {
  return glm::dvec3(scene.positions[scene.primitives.front().baseVertex + vertex]);
}

/// Any matrix with entries of a size, and any place.
glm::dmat4 anyMatrix() {
  const auto entry = [] { return 0.01 * *rc::gen::inRange(-50, 51); };
  glm::dmat4 matrix(1.0);
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 3; ++row) matrix[column][row] = entry();
  }
  return matrix;
}

TEST(Silhouettes, ACubeFromAboveIsItsUpperSquare) {
  const Scene scene = load(testing::cube());
  for (const glm::dvec4& light : {glm::dvec4(0, 1, 0, 0), glm::dvec4(0.1, 5, 0.2, 1)}) {
    const auto signs = facingsOf(scene, glm::dmat4(1.0), light);
    EXPECT_EQ(std::count(signs.begin(), signs.end(), 1), 2);
    const auto outline = outlineOf(scene, only(signs, 1));
    ASSERT_EQ(outline.size(), 4u);
    for (const SilhouetteEdge& edge : outline) {
      const glm::dvec3 from = positionOf(scene, edge.from);
      const glm::dvec3 to = positionOf(scene, edge.to);
      EXPECT_EQ(from.y, 1);
      EXPECT_EQ(to.y, 1);
      EXPECT_GT(glm::cross(from, to).y, 0) << "from above, the square lies to the left";
    }
  }
}

TEST(Silhouettes, G4_SignsAreThoseOfTheTrianglesInTheWorldHoweverTheyArePlaced) {
  // Held against exact arithmetic: everything is a whole number of hundredths.
  const Scene scene = load(testing::cube());
  EXPECT_TRUE(rc::check([&] {
    const glm::dmat4 matrix = anyMatrix();
    const auto place = [] { return 0.01 * *rc::gen::inRange(-500, 501); };
    const glm::dvec4 light(place(), place(), place(), *rc::gen::element(0.0, 1.0));
    RC_PRE(glm::length(glm::dvec3(light)) > 0);
    const auto signs = facingsOf(scene, matrix, light);
    const auto whole = [](double hundredths) { return static_cast<std::int64_t>(std::llround(hundredths * 100)); };
    for (std::size_t t = 0; t < signs.size(); ++t) {
      std::int64_t corner[3][3];
      for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec4 at = matrix * glm::dvec4(positionOf(scene, scene.welded[3 * t + i]), 1.0);
        for (int axis = 0; axis < 3; ++axis) corner[i][axis] = whole(at[axis]);
      }
      std::int64_t a[3];
      std::int64_t b[3];
      std::int64_t l[3];
      for (int axis = 0; axis < 3; ++axis) {
        a[axis] = corner[1][axis] - corner[0][axis];
        b[axis] = corner[2][axis] - corner[0][axis];
        l[axis] = whole(light[axis]) - (light.w == 0 ? 0 : corner[0][axis]);
      }
      const std::int64_t n[] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
      const std::int64_t height = n[0] * l[0] + n[1] * l[1] + n[2] * l[2];
      const double lengths = glm::length(glm::dvec3(n[0], n[1], n[2])) * glm::length(glm::dvec3(l[0], l[1], l[2]));
      if (height != 0 && std::abs(static_cast<double>(height)) < 2e-6 * lengths) continue; // as good as edge-on
      RC_ASSERT(static_cast<int>(signs[t]) == (height > 0) - (height < 0));
    }
  }));
}

TEST(Silhouettes, AMillionMetresAwayNothingChanges) {
  const Scene scene = load(testing::cube());
  EXPECT_TRUE(rc::check([&] {
    const auto place = [] { return static_cast<double>(*rc::gen::inRange(-500, 501)) / 64; };
    const glm::dvec4 light(place(), place(), place(), 1.0);
    const glm::dvec3 far(1e6, -2e6, 1e7);
    RC_ASSERT(facingsOf(scene, glm::dmat4(1.0), light) ==
              facingsOf(scene, glm::translate(glm::dmat4(1.0), far), light + glm::dvec4(far, 0.0)));
  }));
}

TEST(Silhouettes, WhatIsSquashedFlatAlongTheLightIsEdgeOn) {
  const Scene scene = load(testing::cube());
  const auto flat = glm::scale(glm::dmat4(1.0), glm::dvec3(1, 0, 1));
  const auto across = facingsOf(scene, flat, {0, 1, 0, 0});
  EXPECT_EQ(std::count(across.begin(), across.end(), 0), 8) << "the sides have no area";
  const auto along = facingsOf(scene, flat, {1, 0, 0, 0});
  EXPECT_EQ(std::count(along.begin(), along.end(), 0), 12);
  const auto point = facingsOf(scene, glm::scale(glm::dmat4(1.0), glm::dvec3(0.0)), {0, 1, 0, 1});
  EXPECT_EQ(std::count(point.begin(), point.end(), 0), 12);
}

TEST(Silhouettes, ALightInATrianglesPlaneSeesItEdgeOn) {
  const Scene scene = load(testing::plane());
  for (const double height : {0.0, 1e-9, -1e-9}) {
    const auto signs = facingsOf(scene, glm::dmat4(1.0), {0.1, height, 0.2, 1});
    EXPECT_EQ(std::count(signs.begin(), signs.end(), 0), 2) << height;
  }
  EXPECT_EQ(facingsOf(scene, glm::dmat4(1.0), {0.1, 1e-3, 0.2, 1}).front(), 1);
  EXPECT_EQ(facingsOf(scene, glm::dmat4(1.0), {1, 1e-9, 0, 0}).front(), 1) << "directions are told apart to 1e-12";
}

TEST(Silhouettes, AnOpenMeshIsOutlinedAtItsRimAndTwiceAtItsFolds) {
  Scene scene = load(testing::plane());
  EXPECT_EQ(outlineOf(scene, {1, 1}).size(), 4u);
  EXPECT_EQ(outlineOf(scene, {1, -1}).size(), 4u + 2u);
  EXPECT_TRUE(outlineOf(scene, {0, 0}).empty());
}

} // namespace
} // namespace gnomon
