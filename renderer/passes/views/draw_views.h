#pragma once

#include <map>
#include <vector>

#include "renderer/passes/views/exact_shadows.h"
#include "renderer/passes/views/view_pass.h"

namespace gnomon {

/// A frame's views, and what they were made from.
struct DrawnViews {
  std::map<int, Surfaces> surfaces; ///< by samples a pixel
  std::map<int, ExactShadows>
      exactShadows;                    ///< by samples a pixel; only where a light asks for them and a view shows it
  std::map<int, VolumeLayers> volumes; ///< by samples a pixel; only where the frame has volumes and a view shows them
  std::map<int, SkyTexture> skies;     ///< by samples a pixel; only where a view shows what an environment's rays find
  CasterNodes casters;                 ///< empty where no view asks for them
  gl::Texture flatAtlas;               ///< R32F; empty where the atlas can be read as it is, or no view asks for it
  std::vector<DrawnView> views;        ///< one a request; an empty one for what is read from the atlas
};

/// Draws the surfaces once for each number of samples that the views want, and every view from them.
Result<DrawnViews> drawViews(const PassInputs& inputs, const Shading& shading, const FrameWork& work,
                             const ShowInput& show);

} // namespace gnomon
