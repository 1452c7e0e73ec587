#pragma once

#include <vector>

#include "protocol/spec/limits.h"
#include "renderer/scene/document/gltf_document.h"
#include "renderer/scene/findings.h"
#include "renderer/scene/known_content.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// Takes over the images that the materials use, still encoded, after the sizes of all of them and the structure of
/// each have been checked, and points the materials' textures at them. A texture in a format that is not supported is
/// left out with a warning. Images in `known` are taken from there.
SceneImages loadImages(const GltfDocument& document, const Limits& limits, std::vector<Material>& materials,
                       Findings& findings, KnownContent* known = nullptr);

} // namespace gnomon
