#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "clients/cli/files/request_files.h"
#include "protocol/base/result.h"
#include "protocol/base/scene_bundle.h"
#include "protocol/spec/limits.h"

namespace gnomon::cli {

/// The `uri` of every buffer and image of a glTF or GLB that is no data: URI, as written, each once. What can't be
/// read as glTF gives none: judging it is the loader's.
std::vector<std::string> externalUris(std::span<const std::uint8_t> model);

/// How a model is read.
struct SceneFileOptions {
  bool strict = false;            ///< refused where it violates glTF, instead of repaired
  bool allowOutsideFiles = false; ///< files outside of the model's folder are opened, too
};

/// Reads a .glb or .gltf and the files that it names; "-" is standard input, whose files lie in the current folder.
/// Files outside of the model's folder, symbolic links followed, are refused unless the options allow them, and nothing
/// of them is opened. Those that are not there are left to the loader. `files`: what the request names is read as well,
/// from the model's folder, or from where a flag says that it lies.
Result<SceneBundle> readSceneFile(const std::filesystem::path& path, const SceneFileOptions& options = {},
                                  std::span<const RequestFile> files = {}, const Limits& limits = kLimits);

} // namespace gnomon::cli
