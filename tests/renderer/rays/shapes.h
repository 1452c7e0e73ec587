#pragma once

#include <glm/gtc/constants.hpp>

#include "tests/renderer/rays/traced.h"

namespace gnomon::testing {

/// A flat quadrilateral of two triangles, at the root of the scene; returns its node.
inline int addQuad(GlbBuilder& builder, const std::vector<Point>& corners) {
  const int positions = builder.addPoints(corners);
  const int indices = builder.addIndices({0, 1, 2, 0, 2, 3});
  return builder.addMeshNode(builder.addMesh({{"attributes", {{"POSITION", positions}}}, {"indices", indices}}));
}

/// A square of `half` metres around the y axis at height `y`, facing up.
inline int addSquare(GlbBuilder& builder, float half, float y) {
  return addQuad(builder, {{-half, y, half}, {half, y, half}, {half, y, -half}, {-half, y, -half}});
}

/// A mesh of cells x cells squares that `place` puts from -1..1 into the world.
template <class Place>
int addGrid(GlbBuilder& builder, int cells, Place place) {
  std::vector<Point> points;
  std::vector<std::uint32_t> indices;
  for (int z = 0; z <= cells; ++z) {
    for (int x = 0; x <= cells; ++x) {
      const glm::dvec3 p = place(2.0 * x / cells - 1, 2.0 * z / cells - 1);
      points.push_back({float(p.x), float(p.y), float(p.z)});
      if (x == cells || z == cells) continue;
      const auto at = std::uint32_t(z * (cells + 1) + x);
      const std::uint32_t below = at + std::uint32_t(cells) + 1;
      for (const std::uint32_t corner : {at, below, at + 1, at + 1, below, below + 1}) indices.push_back(corner);
    }
  }
  const int positions = builder.addPoints(points);
  return builder.addMeshNode(
      builder.addMesh({{"attributes", {{"POSITION", positions}}}, {"indices", builder.addIndices(indices)}}));
}

inline int addSphere(GlbBuilder& builder, const glm::dvec3& center, double radius, int cells) {
  return addGrid(builder, cells, [&](double x, double z) {
    const double polar = glm::pi<double>() * (0.5 + 0.5 * z);
    const double around = -glm::pi<double>() * x;
    return center +
           radius * glm::dvec3(std::sin(polar) * std::cos(around), std::cos(polar), std::sin(polar) * std::sin(around));
  });
}

} // namespace gnomon::testing
