#pragma once

#include <vector>

#include "renderer/scene/animation/motion.h"
#include "renderer/scene/document/gltf_document.h"

namespace gnomon {

/// The animations of the file, in its order. Channels that move what is not animated here are left out with a warning.
std::vector<Animation> readAnimations(const LoadContext& load);

} // namespace gnomon
