#pragma once

#include <vector>

#include "protocol/spec/limits.h"
#include "renderer/scene/findings.h"
#include "renderer/scene/geometry/accessor_view.h"
#include "renderer/scene/gltf_document.h"
#include "renderer/scene/posing/deformation.h"

namespace gnomon {

/// The skins of the file, in its order. Without inverse bind matrices a skin has those of identity.
std::vector<Skin> readSkins(const GltfDocument& document, const std::vector<AccessorView>& accessors,
                            const Limits& limits, Findings& findings);

} // namespace gnomon
