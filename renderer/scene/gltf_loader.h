#pragma once

#include <memory>

#include "protocol/base/result.h"
#include "protocol/base/scene_bundle.h"
#include "protocol/spec/limits.h"
#include "renderer/scene/scene.h"
#include "renderer/scene/shared_content.h"

namespace gnomon {

/// Loads a GLB or a .gltf with its files, all from memory. Pointers of problems are JSON pointers into the glTF. `id`:
/// the summary's. `known`: where meshes and images are found and kept.
Result<std::shared_ptr<const Scene>> loadGltf(const SceneBundle& bundle, const Limits& limits = kLimits,
                                              const std::string& id = {}, KnownContent* known = nullptr);

} // namespace gnomon
