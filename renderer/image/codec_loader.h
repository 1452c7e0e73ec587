#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "protocol/base/result.h"
#include "renderer/image/codec_table.h"

namespace gnomon {

/// Where the codec module may lie: beside the executable, then in ../lib/gnomon from there.
std::vector<std::filesystem::path> codecModulePaths(const std::filesystem::path& executable);

/// Opens the first module that exists among `paths`. It stays open until the process ends.
Result<const codec::Table*> openCodec(std::span<const std::filesystem::path> paths);

/// The module of this process, opened by the first call. Safe from any thread.
Result<const codec::Table*> imageCodec();

} // namespace gnomon
