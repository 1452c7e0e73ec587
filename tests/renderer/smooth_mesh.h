#pragma once

#include <cmath>
#include <numbers>

#include "tests/support/glb_builder.h"

/// Small meshes, most of whose vertices have the normals of the curved surface that they lie on.
namespace gnomon::testing {

/// A mesh of columns x rows quads of two triangles over the unit square; `place(u, v)` and `normal(u, v)` give points
/// and unit normals. Its index.
template <class Place, class Normal>
int addSmoothGrid(GlbBuilder& builder, int columns, int rows, Place place, Normal normal) {
  std::vector<Point> points, normals;
  std::vector<std::uint32_t> indices;
  for (int row = 0; row <= rows; ++row) {
    for (int column = 0; column <= columns; ++column) {
      const double u = double(column) / columns, v = double(row) / rows;
      points.push_back(place(u, v));
      normals.push_back(normal(u, v));
      if (row == rows || column == columns) continue;
      const auto at = std::uint32_t(row * (columns + 1) + column);
      const std::uint32_t below = at + std::uint32_t(columns) + 1;
      for (const std::uint32_t corner : {at, below, below + 1, at, below + 1, at + 1}) indices.push_back(corner);
    }
  }
  const nlohmann::json attributes{{"POSITION", builder.addPoints(points)}, {"NORMAL", builder.addPoints(normals)}};
  return builder.addMesh({{"attributes", attributes}, {"indices", builder.addIndices(indices)}});
}

/// A ball of radius 1 around the origin, made of columns x rows quads. Its mesh.
inline int addSmoothBall(GlbBuilder& builder, int columns = 16, int rows = 8) {
  const auto onBall = [](double u, double v) {
    constexpr double kPi = std::numbers::pi;
    const double polar = kPi * v, around = 2 * kPi * u;
    return Point{float(std::sin(polar) * std::cos(around)), float(std::cos(polar)),
                 float(-std::sin(polar) * std::sin(around))};
  };
  return addSmoothGrid(builder, columns, rows, onBall, onBall);
}

/// A cube from -1 to 1 of eight vertices; `smooth`: with normals away from its middle, else without any. Its mesh.
inline int addCube(GlbBuilder& builder, bool smooth = false) {
  std::vector<Point> corners;
  for (int i = 0; i < 8; ++i) {
    corners.push_back({i & 4 ? 1.0f : -1.0f, i & 2 ? 1.0f : -1.0f, i & 1 ? 1.0f : -1.0f});
  }
  nlohmann::json attributes{{"POSITION", builder.addPoints(corners)}};
  if (smooth) attributes["NORMAL"] = builder.addPoints(corners);
  return builder.addMesh({{"attributes", attributes},
                          {"indices", builder.addShortIndices({0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5, 0, 4, 5, 0, 5, 1, 2,
                                                               3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3})}});
}

/// A rectangle without normals at the root of the scene.
inline int addSheet(GlbBuilder& builder, const std::vector<Point>& corners) {
  const int points = builder.addPoints(corners);
  return builder.addMeshNode(
      builder.addMesh({{"attributes", {{"POSITION", points}}}, {"indices", builder.addIndices({0, 1, 2, 0, 2, 3})}}));
}

} // namespace gnomon::testing
