#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "renderer/prepare/tile_casters.h"
#include "renderer/scene/mesh_edges.h"

namespace gnomon {

/// Tangent of the angle to the light from which on a surface counts as steep: all of its edges are outlines then.
inline constexpr float kSteepest = 2;

/// Where a shadow map alone can't be trusted: a byte a texel of a tile's rectangle, its lowest row first; 255 where the
/// outline of a caster passes through the cell between the texel's centre and those of its neighbours to the right,
/// above and at that corner.
///
/// Outlines, seen from the light: edges between a triangle that faces it and one that doesn't; open edges; all edges of
/// a steep triangle, whose slope to the light is kSteepest or more; and the whole of a masked or blended
/// triangle. So a cell without one has nothing but whole, gently sloped sheets of surface over it.
using TileOutlines = std::vector<std::uint8_t>;

/// What the outlines of one light's tiles are made from. All of it outlives the call.
struct OutlineInput {
  const Scene& scene;
  const SceneView& view;
  const FrameGeometry& geometry;
  std::span<const EdgeMesh> meshes; ///< the scene's
  const Light& light;
  glm::dvec3 anchor{0}; ///< anchorOf(view)
};

/// A tile with what is drawn into it.
struct OutlinedTile {
  const ShadowTile& tile;
  const TileCasters& casters;
};

/// One a tile; all tiles are the light's. On all cores.
std::vector<TileOutlines> outlinesOf(const OutlineInput& input, const std::vector<OutlinedTile>& tiles);

/// Marks the cells of one tile that edges and triangles pass through, given in the tile's clip space (x y -1..1 over
/// the tile after the division by w). A cell lies between the centres of four texels and is named after the lowest.
class Stamps {
 public:
  Stamps(int width, int height);

  void stampEdge(const glm::dvec4& a, const glm::dvec4& b);
  /// The box around the triangle.
  void stampTriangle(const glm::dvec4& a, const glm::dvec4& b, const glm::dvec4& c);

  /// A byte a cell, the lowest row first; 255 = marked. Leaves nothing.
  std::vector<std::uint8_t> take() { return std::move(cells_); }

 private:
  struct Span {
    glm::dvec2 lowest, highest;
  };
  void fill(const Span& box);

  int width_;
  int height_;
  std::vector<std::uint8_t> cells_;
};

} // namespace gnomon
