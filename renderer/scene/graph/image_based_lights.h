#pragma once

#include <memory>
#include <vector>

#include "renderer/environment/environment_file.h"
#include "renderer/scene/document/gltf_document.h"

namespace gnomon {

/// The lights of EXT_lights_image_based, one each; null = it is left out. Of its levels only the first is kept, unread
/// but for headers: what rougher surfaces reflect is summed from it as of every environment. Refuses a face, or faces
/// of all lights together, beyond the limits of images and environments.
std::vector<std::shared_ptr<const EnvironmentFile>> readImageBasedLights(const LoadContext& load);

} // namespace gnomon
