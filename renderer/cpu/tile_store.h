#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <list>
#include <memory>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "renderer/cpu/raster/depth_buffer.h"
#include "renderer/cpu/raster/texel_marks.h"
#include "renderer/prepare/cluster_choice.h"

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
    std::size_t bytes = 0;  ///< as counted last
    std::uint64_t used = 0; ///< the larger, the later
    bool found = false;     ///< again, since it was kept
  };
  using Place = std::list<Entry>::iterator;
  struct Entries {
    std::list<Entry> list; ///< most recently used first
    std::size_t bytes = 0;
  };

  Entries& entriesOf(const Entry& entry) { return entry.found ? found_ : unfound_; }
  std::optional<Place> nextToDrop(std::size_t bytes); ///< nothing where there is room for as many
  void drop(Place place);
  void watch(Place place);
  void countWatched();

  std::size_t budgetBytes_;
  Entries found_;
  Entries unfound_;
  std::unordered_map<std::string_view, Place> places_; ///< by the entries' own keys
  std::vector<Place> watched_;                         ///< whose moments may have become more since they were counted
  std::uint64_t uses_ = 0;
};

} // namespace gnomon::cpu
