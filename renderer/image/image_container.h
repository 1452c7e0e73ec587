#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "protocol/base/result.h"
#include "renderer/image/image.h"
#include "renderer/image/image_codec.h"

/// Sizes and structure of untrusted PNGs, JPEGs and WebPs, without decoding a pixel.
namespace gnomon {

using EncodedBytes = std::span<const std::uint8_t>;

/// The format that the signature claims.
std::optional<PictureFormat> formatOf(EncodedBytes encoded);

Result<ImageSize> pngSize(EncodedBytes encoded);
Result<ImageSize> jpegSize(EncodedBytes encoded);
Result<ImageSize> webpSize(EncodedBytes encoded);

/// The parts of a file that its pixels depend on, as far as it goes; a problem where it has not even a header,
/// unsupportedFeature for an animated WebP.
Result<EssentialImage> essentialPng(EncodedBytes encoded);
Result<EssentialImage> essentialJpeg(EncodedBytes encoded);
Result<EssentialImage> essentialWebp(EncodedBytes encoded);

/// The unsigned number of `count` bytes at `offset`, most significant first. REQUIRES: offset + count <= size.
std::uint32_t bigEndian(EncodedBytes bytes, std::size_t offset, std::size_t count);

/// The same, least significant first.
std::uint32_t littleEndian(EncodedBytes bytes, std::size_t offset, std::size_t count);

Problem malformedImage(const std::string& detail);
Problem unsupportedImage(const std::string& detail);

// How a PNG is laid out: "Portable Network Graphics (PNG) Specification", W3C, sections 5 and 11.

inline constexpr std::array<std::uint8_t, 8> kPngSignature{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
inline constexpr std::size_t kPngFrameBytes = 12;  ///< around a chunk's data: length, type and checksum
inline constexpr std::size_t kPngHeaderBytes = 13; ///< data of the chunk IHDR

} // namespace gnomon
