#pragma once

#include <vector>

#include "renderer/scene/document/gltf_document.h"
#include "renderer/scene/posing/deformation.h"

namespace gnomon {

/// The skins of the file, in its order. Without inverse bind matrices a skin has those of identity.
std::vector<Skin> readSkins(const LoadContext& load);

/// Refuses meshes, drawn or not, whose joints reach past the skin of the node that they hang on.
void checkJoints(const LoadContext& load);

} // namespace gnomon
