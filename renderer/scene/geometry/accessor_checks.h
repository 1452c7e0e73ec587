#pragma once

#include <vector>

#include "renderer/scene/document/gltf_document.h"
#include "renderer/scene/geometry/accessor_view.h"

namespace gnomon {

/// A view of each accessor; kFaultyAccessor, and a repair, of those that can't be read.
std::vector<AccessorView> viewAccessors(const GltfDocument& document, const Limits& limits, Findings& findings);

/// Repairs accessors whose elements violate glTF, also those that nothing uses: floats that are not finite, and a
/// stated min or max that the elements do not have.
void checkContents(const LoadContext& load);

} // namespace gnomon
