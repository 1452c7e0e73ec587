#pragma once

#include "renderer/scene/document/gltf_document.h"

namespace gnomon {

/// Repairs accessors whose elements violate glTF, also those that nothing uses: floats that are not finite, and a
/// stated min or max that the elements do not have.
void checkContents(const LoadContext& load);

} // namespace gnomon
