#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "protocol/base/result.h"
#include "renderer/environment/environment_map.h"

namespace gnomon {

/// Whether the bytes begin as a file does that an environment may be read from: Radiance's or OpenEXR's.
bool isEnvironmentFile(std::span<const std::uint8_t> file);

/// Width and height, from its header alone; nothing where that is broken.
std::optional<glm::ivec2> environmentSize(std::span<const std::uint8_t> file);

/// Reads it, whatever the bytes are. Of an EXR: channels R, G and B, or Y, of its first layer that has them. Problems
/// have no pointer: the file is damaged or of a kind that is not read, has sides that an environment may not have
/// (environment_checks.h), or numbers that light can't have. Takes
/// little more than the map.
Result<EnvironmentMap> readEnvironment(std::span<const std::uint8_t> file);

} // namespace gnomon
