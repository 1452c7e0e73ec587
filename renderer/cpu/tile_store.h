#pragma once

#include <glm/glm.hpp>
#include <list>
#include <memory>
#include <vector>

#include "renderer/cpu/raster/depth_buffer.h"
#include "renderer/cpu/raster/texel_marks.h"
#include "renderer/prepare/tile_casters.h"

namespace gnomon::cpu {

/// One tile of the plan: its texels alone, from its own lowest corner. Those that were never read are never rastered.
struct RasteredTile {
  DepthBuffer depths;
  TexelMarks made;                ///< the others hold anything
  bool blurred = false;           ///< its light's filter reads moments
  std::vector<glm::vec4> moments; ///< row by row from the BOTTOM; empty until they are read

  std::size_t bytes() const; ///< with what is not made yet
};

/// The tiles of the last frames, so that one that was rastered before need not be again. The least recently used are
/// dropped first once they take more than a budget; a budget of 0 keeps nothing.
class TileStore {
 public:
  explicit TileStore(std::size_t budgetBytes) : budgetBytes_(budgetBytes) {}

  /// Null where it is not kept.
  std::shared_ptr<RasteredTile> find(const TileKey& key);
  /// Drops what has to go so that a tile of `bytes` may be kept. Gives the buffer of one as large that was dropped, so
  /// that its memory may be used again; an empty one where none was.
  DepthBuffer room(std::size_t bytes);
  void keep(const TileKey& key, std::shared_ptr<RasteredTile> tile);

 private:
  struct Entry {
    TileKey key;
    std::shared_ptr<RasteredTile> tile;
    std::size_t bytes = 0;
  };

  std::size_t budgetBytes_;
  std::size_t bytes_ = 0;
  std::list<Entry> entries_; ///< most recently used first
};

} // namespace gnomon::cpu
