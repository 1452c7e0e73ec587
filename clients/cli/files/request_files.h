#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "protocol/spec/frame_spec.h"

/// The files that a request names, which are read and uploaded together with the model.
namespace gnomon::cli {

struct RequestFile {
  std::string name;    ///< as the request has it
  std::string pointer; ///< where the request has it
  std::string what;    ///< "volume"
  /// Where a flag says that it lies; nothing = in the model's folder, under its name.
  std::optional<std::filesystem::path> at{};
};

/// Those of the volumes and of the environment. `environment`: what --environment says, if it was given.
std::vector<RequestFile> requestFiles(const FrameSpec& spec, const std::optional<std::string>& environment);

/// The file that --environment names.
RequestFile environmentFile(const std::filesystem::path& file);

/// Where they lie.
std::vector<std::filesystem::path> placesOf(const std::vector<RequestFile>& files, const std::filesystem::path& folder);

} // namespace gnomon::cli
