#pragma once

#include "tests/support/choices.h"
#include "tests/support/glb_builder.h"

/// Small scenes of anything that is hard to draw, made of choices.
namespace gnomon::testing {

struct ChosenScene {
  GlbBuilder builder;
  double scale = 1;                      ///< metres; what casts lies within about 4 times this of the centre
  std::array<double, 3> centre{0, 0, 0}; ///< metres
  int nodes = 0;                         ///< indices of those with a mesh are below this
};

/// Up to four meshes of a few triangles each: ordinary ones, slivers, some without area, some that share edges, on a
/// floor or not; placed by nodes that turn, stretch, mirror, shear, flatten, enlarge or shrink them; of materials with
/// masks, blending, textures and normal maps. The whole may be tiny, huge or far from the origin.
///
/// Materials are never smoother than roughness 0.3, and textures vary little: OpenGL rounds what it keeps of a material
/// to 8 bits, and chooses the level of a texture for two by two pixels, which a mirror or noise would make much of.
ChosenScene chosenScene(Choices& choices);

} // namespace gnomon::testing
