#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "renderer/scene/scene.h"
#include "renderer/scene/scene_image.h"

/// Masks seen from afar: a cutoff applied to the means of a smaller level would open or close holes. So of a level's
/// places as many are kept as of the texture, those of the highest alpha (cf. Castano, "Computing Alpha Mipmaps",
/// 2010), for every cutoff and factor at once: by ranks. Among places of equal alpha a hash of the place decides.
namespace gnomon {

/// A place of a texture that is read for the eye.
struct MaskPlace {
  glm::dvec2 uv{0};
  double halvings = 0; ///< of the texture until a texel is as large as a pixel; more than 0: it is seen smaller
  double alpha = 0;    ///< 0..1, as it was read there from the levels
};

/// How a texture's alpha is spread, level by level.
class MaskCoverage {
 public:
  static constexpr std::size_t kRow = 257; ///< numbers of a row

  /// REQUIRES: countsLevels(levels, use).
  MaskCoverage(const AlphaLevels& levels, const TextureUse& use);

  /// Whether a use reads levels of which coverage can be lost.
  static bool countsLevels(const AlphaLevels& levels, const TextureUse& use);

  /// Whether the surface is there. `factor`: what the texture's alpha is multiplied by.
  bool keeps(const MaskPlace& place, double factor, double cutoff) const;

  /// Rows of kRow numbers: row i of the texture halved i / 2 times; number k is the share of places whose alpha * 255,
  /// rounded, is less than k.
  std::span<const float> table() const { return table_; }
  int rows() const { return static_cast<int>(table_.size() / kRow); }
  bool mixesLevels() const { return mixesLevels_; }
  glm::ivec2 size() const { return size_; } ///< of the texture, texels

 private:
  std::vector<float> table_;
  bool mixesLevels_;
  glm::ivec2 size_;
};

/// One a material of a scene; null where no coverage is lost.
using MaskCoverages = std::vector<std::shared_ptr<const MaskCoverage>>;

/// The coverages of scenes that share their images, each made once, on first use; any thread.
class KeptCoverages {
 public:
  /// For the materials of all that a view places. REQUIRES: the images that they read alpha of are decoded.
  MaskCoverages of(const Scene& scene, const SceneView& view);
  /// The same for all materials.
  MaskCoverages of(const Scene& scene);

 private:
  struct Key {
    int image = 0;
    bool nearest = false;
    MinFilter minFilter = MinFilter::linearMipmapLinear;

    auto operator<=>(const Key&) const = default;
  };
  MaskCoverages of(const Scene& scene, std::span<const std::uint8_t> wanted);

  std::mutex mutex_;
  std::map<Key, std::shared_ptr<const MaskCoverage>> kept_; ///< null where levels have nothing to lose
};

} // namespace gnomon
