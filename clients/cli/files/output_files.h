#pragma once

#include <optional>
#include <string>
#include <vector>

#include "clients/cli/render/rendered.h"
#include "protocol/base/result.h"

namespace gnomon::cli {

/// "png" or "exr" by the name's suffix; nothing for any other, and for "-" (standard output).
std::optional<std::string> formatOf(const std::string& output);

/// Where a picture goes: the output itself, or, one of several, "frame.depth.png" for view depth of "frame.png".
std::string pictureFile(const std::string& output, const std::string& view, std::size_t pictureCount);

/// Writes every picture, each file in one step; gives their names. Standard output takes one picture only.
Result<std::vector<std::string>> writePictures(const std::vector<Picture>& pictures, const std::string& output);

} // namespace gnomon::cli
