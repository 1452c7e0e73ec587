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

/// The picture with nothing but the parts that its pixels depend on: metadata is where decoders are attacked.
/// Fails where the file is cut short; an animated WebP is unsupportedFeature.
Result<Bytes> essentialPng(EncodedBytes encoded);
Result<Bytes> essentialJpeg(EncodedBytes encoded);
Result<Bytes> essentialWebp(EncodedBytes encoded);

/// The unsigned number of `count` bytes at `offset`, most significant first. REQUIRES: offset + count <= size.
std::uint32_t bigEndian(EncodedBytes bytes, std::size_t offset, std::size_t count);

/// The same, least significant first.
std::uint32_t littleEndian(EncodedBytes bytes, std::size_t offset, std::size_t count);

Problem malformedImage(const std::string& detail);
Problem unsupportedImage(const std::string& detail);

} // namespace gnomon
