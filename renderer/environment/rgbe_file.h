#pragma once

#include <cstdint>
#include <span>

#include "protocol/base/result.h"
#include "renderer/environment/environment_map.h"

namespace gnomon {

/// Whether the bytes begin as a picture of Radiance does.
bool isRgbe(std::span<const std::uint8_t> file);

/// Width and height of a picture of Radiance, from its header alone; see readRgbe.
Result<glm::ivec2> rgbeSize(std::span<const std::uint8_t> file);

/// A picture of Radiance (.hdr, .pic), flat or run-length encoded in either way: Ward, "Real Pixels", Graphics Gems II,
/// 1991, and Radiance's "File Formats". Numbers are mantissa * 2^(exponent - 136), as most programs read them, divided
/// by every EXPOSURE and COLORCORR; PRIMARIES are taken for those of sRGB. Problems: damaged or cut short; the format
/// XYZE; rows that do not go from top to bottom and from left to right; sides that an environment may not have. What
/// stands after the last row is ignored. Numbers are finite or infinite, and not negative.
Result<EnvironmentMap> readRgbe(std::span<const std::uint8_t> file);

} // namespace gnomon
