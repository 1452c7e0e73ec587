#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

/// How a PNG is laid out: "Portable Network Graphics (PNG) Specification", W3C, sections 5 and 11.
namespace gnomon {

inline constexpr std::array<std::uint8_t, 8> kPngSignature{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
inline constexpr std::size_t kPngFrameBytes = 12;  ///< around a chunk's data: length, type and checksum
inline constexpr std::size_t kPngHeaderBytes = 13; ///< data of the chunk IHDR

} // namespace gnomon
