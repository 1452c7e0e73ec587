#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "protocol/base/result.h"
#include "protocol/base/scene_bundle.h"
#include "protocol/spec/limits.h"
#include "protocol/spec/volume_options.h"

namespace gnomon::cli {

/// The `uri` of every buffer and image of a glTF or GLB that is no data: URI, as written, each once. What can't be
/// read as glTF gives none: judging it is the loader's.
std::vector<std::string> externalUris(std::span<const std::uint8_t> model);

/// Reads a .glb or .gltf and the files that it names beside it; "-" is standard input, whose files lie in the current
/// folder. A name must be relative and stay inside the model's
/// folder, symbolic links followed; anything else is refused, and nothing of it is opened.
Result<SceneBundle> readSceneFile(const std::filesystem::path& path, const Limits& limits = kLimits);

/// The same, and the files of these volumes, which lie in the model's folder, too.
Result<SceneBundle> readSceneFile(const std::filesystem::path& path, std::span<const VolumeOptions> volumes,
                                  const Limits& limits = kLimits);

} // namespace gnomon::cli
