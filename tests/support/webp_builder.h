#pragma once

#include <cstdint>
#include <string_view>

#include "renderer/image/image.h"

/// WebP files without a compressor, so that a test knows every byte of them and can tell any lie.
namespace gnomon::testing {

/// Type, length, payload and padding.
Bytes webpChunk(std::string_view type, const Bytes& payload);

/// The container around its chunks.
Bytes webpFile(const Bytes& chunks);

/// A VP8X payload. flags: 0x10 alpha, 0x02 animation.
Bytes webpCanvas(std::uint8_t flags, std::uint32_t width, std::uint32_t height);

/// A lossless bitstream of these pixels: width * height * 4 bytes, RGBA. It says whether its alpha means anything.
Bytes losslessBitstream(int width, int height, const Bytes& rgba, bool alphaIsUsed = true);

/// A file of nothing but a lossless picture.
Bytes losslessWebp(int width, int height, const Bytes& rgba, bool alphaIsUsed = true);

} // namespace gnomon::testing
