#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "protocol/base/result.h"
#include "renderer/image/image.h"
#include "renderer/image/image_codec.h"

/// What can be told about a PNG, JPEG or WebP without decoding a pixel. Every byte is untrusted.
namespace gnomon {

using EncodedBytes = std::span<const std::uint8_t>;

/// The format that the signature claims.
std::optional<PictureFormat> formatOf(EncodedBytes encoded);

Result<ImageSize> pngSize(EncodedBytes encoded);
Result<ImageSize> jpegSize(EncodedBytes encoded);
Result<ImageSize> webpSize(EncodedBytes encoded);

/// The picture with nothing but the parts that its pixels depend on: metadata is where decoders are attacked. Of a file
/// that is cut short, those that it has, the last one perhaps not whole; fails where that is not even a header. An
/// animated WebP is unsupportedFeature.
Result<EssentialImage> essentialPng(EncodedBytes encoded);
Result<EssentialImage> essentialJpeg(EncodedBytes encoded);
Result<EssentialImage> essentialWebp(EncodedBytes encoded);

/// The unsigned number of `count` bytes at `offset`, most significant first. REQUIRES: offset + count <= size.
std::uint32_t bigEndian(EncodedBytes bytes, std::size_t offset, std::size_t count);

/// The same, least significant first.
std::uint32_t littleEndian(EncodedBytes bytes, std::size_t offset, std::size_t count);

Problem malformedImage(const std::string& detail);
Problem unsupportedImage(const std::string& detail);

} // namespace gnomon
