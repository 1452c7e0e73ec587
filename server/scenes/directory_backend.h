#pragma once

#include <chrono>

#include "server/scenes/scene_backend.h"

namespace gnomon {

/// Scenes in a directory that other servers may share; makes it if need be, and cleans it up. `quotaBytes`: of their
/// bundles together; 0 = none. `age`: scenes not used for so long go; 0 = never.
Result<std::unique_ptr<SceneBackend>> openSceneDirectory(const std::string& path, std::uint64_t quotaBytes,
                                                         std::chrono::seconds age);

} // namespace gnomon
