#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "protocol/base/bytes.h"
#include "protocol/base/result.h"
#include "renderer/image/image.h"

namespace gnomon {

/// The size of an encoded image, read from its header alone.
struct ImageSize {
  int width = 0;
  int height = 0;
};

/// Size of a PNG, JPEG or still WebP, from its header alone; anything else is unsupportedFeature.
Result<ImageSize> imageSize(std::span<const std::uint8_t> encoded);

/// What is read: the formats of glTF and of EXT_texture_webp.
enum class PictureFormat { png, jpeg, webp };

/// The parts of an encoded image that its pixels depend on.
struct EssentialImage {
  Bytes bytes;
  bool cutShort = false; ///< the file ends before the picture does
};

/// An encoded image whose header holds, and its structure as far as the file goes.
struct CheckedImage {
  PictureFormat format = PictureFormat::png;
  ImageSize size;
  EssentialImage picture;
};

/// Checks a PNG, JPEG or still WebP without decoding a pixel; refuses more than `maxSide` a side or `maxPixels` in all,
/// but not files cut short behind their header.
Result<CheckedImage> checkImage(std::span<const std::uint8_t> encoded, int maxSide, std::int64_t maxPixels);

/// 8-bit RGBA; rows that can't be read are black and transparent, of a JPEG grey and opaque.
struct DecodedImage {
  Image image;
  std::string wrong; ///< with its data, in the decoder's words; empty = nothing
};
DecodedImage decodeImage(const CheckedImage& image);

/// Takes complete rows, 8-bit RGBA, from row `first` on; they are gone when it returns.
using TakeRows = std::function<void(int first, std::span<const std::uint8_t> rgba)>;

/// The same, `atOnce` rows at a time (a multiple of 16; at the end fewer), or all at once of interlaced PNGs and WebPs.
/// Returns what is wrong with its data; empty = nothing.
std::string decodeRows(const CheckedImage& image, int atOnce, const TakeRows& take);

/// Both in turn; a problem where anything is wrong.
Result<Image> decodeImage(std::span<const std::uint8_t> encoded, int maxSide, std::int64_t maxPixels);

/// The channels of an EXR layer: "depth.Z" is channel Z of "depth"; without a name "main", or that of the part where
/// none of its channels has one.
struct ExrLayer {
  std::string name;
  Image image; ///< floats as they stand in the file, over its data window: linear, color multiplied by its alpha
};

/// Whether the bytes begin as an EXR does.
bool isExr(std::span<const std::uint8_t> file);

/// Every layer of a file's parts, at full size. Problems: no EXR, damaged or deep; channels of fewer pixels than their
/// part; two layers of one name; more than `maxSide` pixels a side or `maxValues` numbers in all.
Result<std::vector<ExrLayer>> decodeExr(std::span<const std::uint8_t> file, int maxSide, std::int64_t maxValues);

/// The size of the part that decodeExrColor reads, from the file's header alone.
Result<ImageSize> exrColorSize(std::span<const std::uint8_t> file);

/// Where the floats of a picture of this size go: three a pixel, row by row.
using RoomForColors = std::function<std::span<float>(const ImageSize&)>;

/// Channels R, G and B as floats, or Y three times, of the first layer that has them, without its alpha; other channels
/// are not read. Asks for room once. Problems: as of decodeExr, and where no layer has colors.
Status decodeExrColor(std::span<const std::uint8_t> file, int maxSide, const RoomForColors& roomFor);

} // namespace gnomon
