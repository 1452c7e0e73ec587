#pragma once

#include <vector>

#include "renderer/scene/document/gltf_document.h"
#include "renderer/scene/geometry/accessor_view.h"

namespace gnomon {

/// A view of each accessor. Accessors that break a rule are told in the findings, and their views are empty.
std::vector<AccessorView> viewAccessors(const GltfDocument& document, const Limits& limits, Findings& findings);

} // namespace gnomon
