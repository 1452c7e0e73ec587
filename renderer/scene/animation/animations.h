#pragma once

#include <vector>

#include "protocol/spec/limits.h"
#include "renderer/scene/animation/motion.h"
#include "renderer/scene/findings.h"
#include "renderer/scene/geometry/accessor_view.h"
#include "renderer/scene/gltf_document.h"

namespace gnomon {

/// The animations of the file, in its order. Channels that move what is not animated here are left out with a warning.
std::vector<Animation> readAnimations(const GltfDocument& document, const std::vector<AccessorView>& accessors,
                                      const Limits& limits, Findings& findings);

} // namespace gnomon
