#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "protocol/base/bytes.h"
#include "protocol/base/result.h"

namespace gnomon::cli {

/// The whole file, refused before reading when it is larger than `maxBytes`. Problems name `path` as the user gave it.
Result<Bytes> readFile(const std::filesystem::path& path, std::size_t maxBytes);

/// The same as text; "-" is standard input.
Result<std::string> readText(const std::string& path, std::size_t maxBytes);

/// Puts the file in place in one step: whoever looks sees the old file or the whole new one. "-" is standard output.
Status writeFile(const std::string& path, std::span<const std::uint8_t> bytes);

} // namespace gnomon::cli
