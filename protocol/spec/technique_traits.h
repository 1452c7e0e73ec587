#pragma once

#include <array>

#include "protocol/spec/enum_rows.h"

namespace gnomon {

/// What a shadow technique is and needs: one row each, complete by static_assert.
struct TechniqueTraits {
  ShadowTechnique technique;
  bool mapped;             ///< draws shadow maps
  bool layered;            ///< says of every sample what share of the light arrives; a map only helps to find it
  bool traced;             ///< traces rays
  bool needsEdges;         ///< needs to know the edges of the casters' meshes
  bool knowsSize;          ///< soft where the light has a size
  bool needsOpaqueCasters; ///< can't tell the holes of a masked or blended caster
  bool oneDepthATexel;     ///< can't read an atlas of several samples

  /// The map only spares rays: what it is sure of is not traced.
  constexpr bool mapSparesRays() const { return mapped && layered; }
};

// clang-format off
inline constexpr std::array kTechniqueTraits{
    //               technique                    mapped layered traced edges  size   opaque one depth
    TechniqueTraits{ShadowTechnique::shadowMap,    true,  false, false, false, false, false, false},
    TechniqueTraits{ShadowTechnique::hybrid,       true,  true,  true,  true,  false, false, true},
    TechniqueTraits{ShadowTechnique::shadowVolume, false, true,  false, true,  false, true,  false},
    TechniqueTraits{ShadowTechnique::rayTraced,    false, true,  true,  false, true,  false, false},
};
// clang-format on
static_assert(rowsAreComplete(kTechniqueTraits, &TechniqueTraits::technique));

constexpr const TechniqueTraits& traitsOf(ShadowTechnique technique) {
  return kTechniqueTraits[static_cast<std::size_t>(technique)];
}

} // namespace gnomon
