#pragma once

#include <filesystem>

#include "protocol/base/result.h"
#include "protocol/spec/limits.h"
#include "renderer/scene/scene_bundle.h"

namespace gnomon::cli {

/// Reads a .glb or .gltf and the files that it names beside it. A name must be relative and stay inside the model's
/// folder, symbolic links followed; anything else is refused, and nothing of it is opened.
Result<SceneBundle> readSceneFile(const std::filesystem::path& path, const Limits& limits = kLimits);

} // namespace gnomon::cli
