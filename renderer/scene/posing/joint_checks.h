#pragma once

#include <vector>

#include "protocol/spec/limits.h"
#include "renderer/scene/findings.h"
#include "renderer/scene/geometry/accessor_view.h"
#include "renderer/scene/gltf_document.h"

namespace gnomon {

/// Refuses meshes, drawn or not, whose joints reach past the skin of the node that they hang on.
void checkJoints(const GltfDocument& document, const std::vector<AccessorView>& views, const Limits& limits,
                 Findings& findings);

} // namespace gnomon
