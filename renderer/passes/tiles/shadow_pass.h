#pragma once

#include <memory>
#include <span>
#include <vector>

#include "protocol/base/lru.h"
#include "protocol/base/result.h"
#include "protocol/spec/frame_spec.h"
#include "renderer/core/rect.h"
#include "renderer/gl/texture.h"
#include "renderer/gl/timer.h"
#include "renderer/passes/pass_inputs.h"
#include "renderer/prepare/cluster_choice.h"
#include "renderer/shadow/shadow_plan.h"

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

/// What was drawn into one tile.
struct TileCounts {
  std::uint64_t casterTriangles = 0;
  std::uint64_t culledTriangles = 0;
  std::size_t drawCalls = 0;
  bool reused = false; ///< an earlier frame's tile serves; nothing was drawn
  gl::Timer timer;     ///< of drawing; the first tile's brings finding all casters and clearing the atlas
};

/// Every light's tiles, drawn.
struct ShadowAtlas {
  std::shared_ptr<const AtlasTextures> textures = std::make_shared<AtlasTextures>(); ///< without any for an empty plan
  std::vector<TileCounts> tiles;                                                     ///< one a tile of the plan
  std::size_t drawCalls = 0;
  gl::Timer timer; ///< of all tiles
};

/// `spec`: effective. Tiles that the cache has are taken from it, and the cache keeps the new ones.
Result<ShadowAtlas> castShadows(const PassInputs& inputs, const ShadowPlan& plan, const FrameSpec& spec,
                                TileCache& cache);

} // namespace gnomon
