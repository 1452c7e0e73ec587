#pragma once

#include <vector>

#include "protocol/limits.h"
#include "renderer/scene/findings.h"
#include "renderer/scene/geometry/accessor_view.h"
#include "renderer/scene/gltf_document.h"

namespace gnomon {

/// Refuses meshes whose joints reach past the skin of the node that they hang on.
void checkSkins(const GltfDocument& document, const std::vector<AccessorView>& views, const Limits& limits,
                Findings& findings);

} // namespace gnomon
