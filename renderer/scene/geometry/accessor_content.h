#pragma once

#include "renderer/scene/document/gltf_document.h"

namespace gnomon {

/// Tells of accessors whose elements are not what glTF allows, whoever reads them: floats that are not finite, and a
/// stated min or max that the elements do not have.
void checkContents(const LoadContext& load);

} // namespace gnomon
