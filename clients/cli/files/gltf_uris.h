#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace gnomon::cli {

/// The `uri` of every buffer and image of a glTF or GLB that is no data: URI, as written, each once. What can't be
/// read as glTF gives none: judging it is the loader's.
std::vector<std::string> externalUris(std::span<const std::uint8_t> model);

} // namespace gnomon::cli
