#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/cpu/frame_scene.h"
#include "renderer/cpu/raster/depth_buffer.h"
#include "renderer/cpu/raster/raster_triangles.h"
#include "renderer/prepare/tile_casters.h"
#include "renderer/shaders/shared/frame_types.h"
#include "renderer/shadow/shadow_plan.h"

namespace gnomon::cpu {

/// Texels of a tile from a lowest to a greatest one, which belongs to them.
struct TexelBox {
  int x0, y0, x1, y1;
};

/// Where large triangles that the camera sees lie open to a parallel light, told without its tile's texels: nothing
/// comes nearer to the light there than they do. So it is on most of a floor around the things that stand on it. Other
/// casters count by how near the cells that they may touch hold any of them.
class CasterGrid {
 public:
  /// Knows nothing: nothing lies open.
  CasterGrid() = default;
  /// `casters`: the slots that may cast into the tile, a byte each; `seen`: as largestSeen gives them.
  CasterGrid(const FrameScene& scene, const ShadowTile& tile, std::span<const std::uint8_t> casters,
             std::span<const std::uint32_t> seen);

  /// False unless `triangle` is one of the seen ones and no caster comes nearer to the light than its plane over the
  /// texels, which may lie beyond the tile. One in the plane itself, within the tile's bias, does not.
  bool isOpen(std::uint32_t triangle, const TexelBox& texels) const;

 private:
  static constexpr int kCellSide = 16; ///< texels

  /// x y in texels, z the depth.
  struct Corners {
    glm::dvec3 at[3];
  };
  struct SeenTriangle {
    std::uint32_t number;
    bool casts;
    Corners corners;
    DepthPlane plane;
  };

  void addSlot(const FrameScene& scene, std::size_t slot, std::span<const std::uint32_t> seen);
  void addTriangle(const Corners& corners);
  void addBox(const TexelBox& cells, double nearest);
  Corners cornersOf(const FrameScene& scene, std::uint32_t triangle) const;
  TexelBox cellsAround(const glm::dvec2& low, const glm::dvec2& high) const;

  glm::dmat4 texelsFromRelative_{1}; ///< depths stay
  double tolerance_ = 0;             ///< of depths: planes that differ by no more are one
  int across_ = 0, up_ = 0;          ///< cells
  std::vector<float> nearest_;       ///< the least depth in each cell of all but the seen triangles, row by row
  std::vector<SeenTriangle> seen_;
};

/// One a tile of the plan. They know of the tiles of lights whose lookups say "lit" wherever nothing comes nearer: of
/// parallel light, by its automatic bias and no filter that guesses. On all cores. `casters`: parallel to the tiles;
/// `surfaces`: what the camera sees.
std::vector<CasterGrid> casterGrids(const FrameScene& scene, const ShadowPlan& plan,
                                    std::span<const shared::LightData> lights, std::span<const TileCasters> casters,
                                    const DepthBuffer& surfaces);

} // namespace gnomon::cpu
