#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "clients/cli/render/rendering.h"
#include "protocol/base/bytes.h"
#include "protocol/base/result.h"

namespace gnomon::cli {

/// The whole file, refused before reading when it is larger than `maxBytes`. Problems name `path` as the user gave it.
Result<Bytes> readFile(const std::filesystem::path& path, std::size_t maxBytes);

/// All of standard input, refused once it is larger than `maxBytes`.
Result<Bytes> readStandardInput(std::size_t maxBytes);

/// A file as text; "-" is standard input.
Result<std::string> readText(const std::string& path, std::size_t maxBytes);

/// Puts the file in place atomically: readers see the old file or the whole new one. Makes the folders that it
/// needs. "-" is standard output.
Status writeFile(const std::string& path, std::span<const std::uint8_t> bytes);

/// The `output.format` of the name's suffix; nothing for any other, and for "-" (standard output).
std::optional<std::string> formatOf(const std::string& output);

/// Every suffix that formatOf knows: ".png .exr ...".
std::string suffixList();

/// What is wrong with an output's name: empty where formatOf knows it.
std::string checkPictureName(const std::string& output);

/// Where a picture goes: the output with its {view}, the output itself, or, one of several, "frame.depth.png" for view
/// depth of "frame.png".
std::string pictureFile(const std::string& output, const std::string& view, std::size_t pictureCount);

/// Writes every picture, each file in one step; gives their names. Standard output takes one picture only.
Result<std::vector<std::string>> writePictures(const std::vector<Picture>& pictures, const std::string& output);

} // namespace gnomon::cli
