#pragma once

#include <memory>

#include "protocol/base/result.h"
#include "protocol/base/scene_bundle.h"
#include "protocol/spec/limits.h"
#include "renderer/scene/known_content.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// Loads a GLB or a .gltf with the files it names, all from memory: no file and no address outside the bundle
/// is ever opened. Pointers in the problems are JSON pointers into the glTF ("/accessors/3/count").
/// `id` becomes the summary's. `known`: where meshes and images are found again, and those of this file are kept.
Result<std::shared_ptr<const Scene>> loadGltf(const SceneBundle& bundle, const Limits& limits = kLimits,
                                              const std::string& id = {}, KnownContent* known = nullptr);

} // namespace gnomon
