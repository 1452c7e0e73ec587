#pragma once

#include <array>
#include <glm/glm.hpp>

#include "renderer/reference/ray_packet.h"
#include "renderer/reference/tree.h"

namespace gnomon {

/// The corners of kLanes triangles, a coordinate after the other, in the tree's units.
struct TriangleLanes {
  float a[3][kLanes], b[3][kLanes], c[3][kLanes];

  /// `shown`: a triangle of the tree, or none: then all corners are the anchor.
  void setTriangle(const TracedScene::Tree& tree, unsigned lane, const PlacedTriangle& shown) {
    const auto corners =
        shown.instance == kNoSurface ? std::array{glm::vec3(0), glm::vec3(0), glm::vec3(0)} : tree.corners(shown);
    for (glm::length_t axis = 0; axis < 3; ++axis) {
      a[axis][lane] = corners[0][axis];
      b[axis][lane] = corners[1][axis];
      c[axis][lane] = corners[2][axis];
    }
  }
};

} // namespace gnomon
