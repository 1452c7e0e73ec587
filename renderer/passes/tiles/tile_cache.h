#pragma once

#include <memory>
#include <span>
#include <vector>

#include "protocol/base/lru.h"
#include "renderer/core/rect.h"
#include "renderer/gl/texture.h"
#include "renderer/prepare/cluster_choice.h"

namespace gnomon {

/// A shadow atlas' textures.
struct AtlasTextures {
  gl::Texture depth;   ///< D32F, 0 nearest the light; 1 where nothing casts
  gl::Texture moments; ///< RGBA32F, of the tiles whose filter blurs; empty where none does

  std::size_t bytes() const;
};

/// The atlases of the last frames, so that a tile that was drawn before need not be drawn again. The least recently
/// used are dropped first once they take more than a budget; a budget of 0 keeps nothing.
class TileCache {
 public:
  explicit TileCache(std::size_t budgetBytes) : budgetBytes_(budgetBytes) {}

  /// An atlas that holds all of these tiles; null where none does.
  std::shared_ptr<const AtlasTextures> findAll(std::span<const TileKey> keys);
  /// An atlas that holds the tile; null where none does.
  std::shared_ptr<const AtlasTextures> find(const TileKey& key);
  void keep(std::vector<TileKey> keys, std::shared_ptr<const AtlasTextures> textures);

 private:
  struct Entry {
    std::vector<TileKey> keys; ///< sorted
    std::shared_ptr<const AtlasTextures> textures;
  };

  std::size_t budgetBytes_;
  LruList<Entry> entries_;
};

} // namespace gnomon
