#pragma once

#include <array>
#include <functional>
#include <vector>

#include "renderer/rays/ray_packet.h"
#include "renderer/rays/shaft.h"
#include "renderer/rays/traced_scene.h"

namespace gnomon {

/// False only where a triangle lies outside of the shaft.
bool reachesInto(const Shaft& shaft, const std::array<glm::vec3, 3>& corners);

struct alignas(64) BoxRow {
  float low[3][kLanes];
  float high[3][kLanes];
};

/// Boxes around runs of a scene's triangles, kLanes side by side, and boxes around those: few tests show that a
/// region is empty. In the order of the scene's triangles, which costs little to make; in the units of the tree.
class TriangleBoxes {
 public:
  static constexpr std::uint32_t kRunTriangles = 32;

  /// Consecutive triangles of one instance.
  struct Run {
    PlacedTriangle first;
    std::uint32_t count = 0; ///< at most kRunTriangles
  };

  TriangleBoxes() = default;
  /// REQUIRES: the tree's vertices are placed.
  explicit TriangleBoxes(const TracedScene::Tree& tree);

  /// False only where no triangle that `casts` reaches into the shaft. Gives up, with true, where that takes long.
  bool mayReachInto(const Shaft& shaft, const TracedScene::Tree& tree,
                    const std::function<bool(const PlacedTriangle&)>& casts) const;

  std::size_t runs() const { return runs_.size(); }
  const Run& run(std::size_t number) const { return runs_[number]; }
  std::size_t runOf(const PlacedTriangle& triangle) const {
    return firstRun_[triangle.instance] + triangle.triangle / kRunTriangles;
  }
  static std::uint32_t placeInRun(const PlacedTriangle& triangle) { return triangle.triangle % kRunTriangles; }

  std::size_t bytes() const;

 private:
  std::vector<Run> runs_;
  std::vector<std::size_t> firstRun_;       ///< of each instance
  std::vector<std::vector<BoxRow>> levels_; ///< the first's boxes hold a run each, the others' a row of the one before
};

} // namespace gnomon
