#pragma once

#include <random>
#include <rapidcheck.h>

#include "tests/renderer/rays/shapes.h"

/// Parts of scenes that properties are checked over. REQUIRES: to be called within rc::check.
namespace gnomon::testing {

/// Triangles in the air, up to half a metre long, around 0 1.5 0; returns their node.
inline int addTriangles(GlbBuilder& builder, std::mt19937& random, int count) {
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<Point> points;
  std::vector<std::uint32_t> indices;
  for (int i = 0; i < count; ++i) {
    const glm::dvec3 middle(3 * unit(random), 1.5 + unit(random), 3 * unit(random));
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3 p = middle + 0.4 * glm::dvec3(unit(random), unit(random), unit(random));
      points.push_back({float(p.x), float(p.y), float(p.z)});
      indices.push_back(std::uint32_t(indices.size()));
    }
  }
  const int positions = builder.addPoints(points);
  return builder.addMeshNode(
      builder.addMesh({{"attributes", {{"POSITION", positions}}}, {"indices", builder.addIndices(indices)}}));
}

/// A sun or a lamp, with or without a size, which may lie in a floor at height 0.
inline Light anyLight(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  const bool sized = *rc::gen::arbitrary<bool>();
  if (*rc::gen::arbitrary<bool>()) {
    return sunAlong({unit(random), 0.3 - *rc::gen::element(0.0, 1.0) * std::abs(unit(random)), unit(random)},
                    sized ? *rc::gen::element(0.53, 5.0, 40.0) : 0);
  }
  Light lamp = pointAt({4 * unit(random), *rc::gen::element(-1.0, 0.01, 2.0, 50.0), 4 * unit(random)},
                       sized ? *rc::gen::element(0.01, 0.2, 3.0) : 0);
  if (*rc::gen::arbitrary<bool>()) lamp.range = 6;
  return lamp;
}

/// From somewhere about 6 m off, towards the middle.
inline CameraView anyView(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  const glm::dvec3 eye(6 * unit(random), *rc::gen::element(0.2, 3.0, 20.0), 6 * unit(random));
  const glm::dvec3 target(unit(random), 0, unit(random));
  return *rc::gen::arbitrary<bool>() ? perspectiveView(eye, target, 70) : parallelView(eye, target - eye, 6);
}

} // namespace gnomon::testing
