#pragma once

#include <span>

#include "renderer/cpu/raster/raster.h"
#include "renderer/cpu/surface/textures.h"
#include "renderer/scene/mask_coverage.h"

namespace gnomon::cpu {

/// What triangles with holes are seen by. All of it outlives MaterialHoles.
struct HolesInput {
  const FrameScene& scene;
  const Textures& textures;
  std::span<const glm::mat4> clipFromLocal; ///< one an instance
  glm::ivec2 size{0};                       ///< of what is rastered, places
  glm::ivec2 corner{0};                     ///< where it lies in the atlas, texels: patterns depend on it
  bool byLight = false; ///< alpha is that of the texture itself, not of its level that has texels as large as places
  bool dithers = false; ///< materials that blend leave out as much as their alpha says; else as masks
  const MaskCoverages* masks = nullptr; ///< one a material, for the eye; none for a light
};

/// The holes of materials with alpha: as the place's alpha, at the pixel's centre whatever the sample, is below the
/// material's cutoff, or below the pattern of what is dithered; of smaller levels as MaskCoverage says.
class MaterialHoles final : public Holes {
 public:
  explicit MaterialHoles(const HolesInput& input) : input_(input) {}
  unsigned filled(const HoledPlaces& places, unsigned asked) const override;

 private:
  HolesInput input_;
};

} // namespace gnomon::cpu
