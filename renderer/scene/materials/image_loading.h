#pragma once

#include <memory>
#include <vector>

#include "protocol/spec/limits.h"
#include "renderer/scene/document/gltf_document.h"
#include "renderer/scene/findings.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// Decodes the images that the materials use, after the sizes of all of them have been held against the limits,
/// and points the materials' textures at them. A texture in a format that is not supported is left out with a warning.
std::vector<std::shared_ptr<const Image>> loadImages(const GltfDocument& document, const Limits& limits,
                                                     std::vector<Material>& materials, Findings& findings);

} // namespace gnomon
