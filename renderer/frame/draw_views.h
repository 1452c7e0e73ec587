#pragma once

#include <map>
#include <vector>

#include "renderer/passes/views/view_pass.h"
#include "renderer/techniques/exact_shadows.h"

namespace gnomon {

/// A frame's views, and what they were made from.
struct DrawnViews {
  std::map<int, Surfaces> surfaces;         ///< by samples a pixel
  std::map<int, ExactShadows> exactShadows; ///< alike; only where a light asks for them and a view shows them
  CasterNodes casters;                      ///< empty where no view asks for them
  gl::Texture flatAtlas;        ///< R32F; empty where the atlas can be read as it is, or no view asks for it
  std::vector<DrawnView> views; ///< one a view of the spec, in its order; an empty one for what is not drawn
  /// What views of errors are made from: the debug light's shadow at full strength, as floats, and the color behind the
  /// picture, where no view is that already.
  std::map<View, DrawnView> besides;
};

/// Draws the surfaces once for each number of samples that the views want, and every view from them. `shown` is the
/// plan's light that debug views show; null where that has no tiles.
Result<DrawnViews> drawViews(const PassInputs& inputs, const ViewInputs& shading, const ExactInputs& exact,
                             const ShadowPlan& plan, const PlannedLight* shown);

} // namespace gnomon
