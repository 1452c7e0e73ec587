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
  TexelMarks made; ///< the others' depths hold anything
  /// Of a tile whose light's filter reads moments: row by row from the BOTTOM; else empty.
  std::vector<glm::vec4, Unfilled<glm::vec4>> moments;
  TexelMarks blurred; ///< the others' moments hold anything

  std::size_t bytes() const; ///< with depths that are not made yet; of moments those that are
};

/// The tiles of the last frames, so that one that was rastered before need not be again. The least recently used are
/// dropped first once they take more than a budget; a budget of 0 keeps nothing. Of tiles of earlier frames
/// that were never found again, which is every one while a camera moves, no more than a quarter of the budget is kept.
class TileStore {
 public:
  explicit TileStore(std::size_t budgetBytes) : budgetBytes_(budgetBytes) {}

  /// Null where it is not kept.
  std::shared_ptr<RasteredTile> find(const TileKey& key);
  /// Drops what has to go so that a tile of `bytes` may be kept. Gives one of as many depths that was dropped, so that
  /// its memory may be used again; an empty one where none was.
  RasteredTile room(std::size_t bytes);
  void keep(const TileKey& key, std::shared_ptr<RasteredTile> tile);

 private:
  struct Entry {
    TileKey key;
    std::shared_ptr<RasteredTile> tile;
    bool found = false; ///< again, since it was kept
  };
  using Entries = std::list<Entry>;

  Entries::iterator nextToDrop(std::size_t bytes); ///< none, the end, where there is room for as many

  std::size_t bytes() const;
  std::size_t newBytes() const; ///< of those that were not found again

  std::size_t budgetBytes_;
  Entries entries_; ///< most recently used first
};

} // namespace gnomon::cpu
