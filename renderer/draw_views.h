#pragma once

#include <map>
#include <vector>

#include "renderer/passes/view_pass.h"

namespace gnomon {

/// A frame's views, and what they were made from.
struct DrawnViews {
  std::map<int, Surfaces> surfaces; ///< by samples a pixel
  std::vector<DrawnView> views;     ///< one a view of the spec, in its order; an empty one for the atlas
};

/// Draws the surfaces once for each number of samples that the views want, and every view from them.
Result<DrawnViews> drawViews(const PassInputs& inputs, const ViewInputs& shading);

} // namespace gnomon
