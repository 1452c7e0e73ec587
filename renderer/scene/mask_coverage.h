#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "renderer/scene/alpha_plane.h"
#include "renderer/scene/scene.h"

/// Masks seen from afar. A smaller level holds means, and a cutoff applied to means opens or closes holes that it
/// cannot tell apart: leaves thin out and vanish. So the eye does not compare what it reads from smaller levels with
/// the cutoff, but with what the level has: of the places of a level as many are kept as of the texture itself, those
/// of the highest alpha (Castano, "Computing Alpha Mipmaps", 2010, scales alpha for one cutoff to that end). Here that
/// is done for every cutoff and every factor at once, by ranks: a place of a level is kept if the share of the level
/// below it is no less than the share of the texture below the cutoff. Where many places have one alpha, as all do once
/// a level has lost its holes, a hash of the place decides among them.
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

  /// Rows of kRow numbers, two a level and one for the last: row i of the texture halved i / 2 times. Number k is the
  /// share of places whose alpha, times 255 and rounded, is less than k. Row 0 is read as what is seen larger is.
  std::span<const float> table() const { return table_; }
  int rows() const { return static_cast<int>(table_.size() / kRow); }
  bool mixesLevels() const { return mixesLevels_; }
  glm::ivec2 size() const { return size_; } ///< of the texture, texels

 private:
  std::vector<float> table_;
  bool mixesLevels_;
  glm::ivec2 size_;
};

/// One a material of a scene; null where no coverage is lost: for opaque ones, and where alpha is not a texture's or
/// its levels are not read.
using MaskCoverages = std::vector<std::shared_ptr<const MaskCoverage>>;

/// Those of scenes that share their images, each made when it is first needed; any thread. Materials that filter one
/// image in the same way share one.
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
