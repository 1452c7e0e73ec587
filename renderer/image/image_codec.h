#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "protocol/base/bytes.h"
#include "protocol/base/result.h"
#include "protocol/spec/output_options.h"
#include "renderer/image/image.h"

namespace gnomon {

/// One layer of an EXR: its channels are written as "name.channel"; an empty name leaves the channel names alone.
struct ImageLayer {
  std::string name;
  const Image* image = nullptr;
  bool wide = false; ///< always floats
};

/// The size of an encoded image, read from its header alone.
struct ImageSize {
  int width = 0;
  int height = 0;
};

/// A float image per layer. Layers of one size share a part; a layer of another size gets a part of its own, and all
/// parts have the first one's size as their display window. Where a layer has an A, its R, G and B (straight, as
/// everywhere here) are multiplied by it, as EXR's convention demands. A channel called Z is always written as float.
/// The bytes depend on nothing but the arguments.
Result<Bytes> encodeExr(std::span<const ImageLayer> layers, ExrCompression compression, ExrPixelType pixelType);

/// Size of a PNG, JPEG or still WebP, told by its signature and header; anything else is unsupportedFeature.
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

/// Checks a PNG, JPEG or still WebP without decoding a pixel. Refuses what is larger than `maxSide` a side or
/// `maxPixels` in all, and what is no such picture; one that is cut short after its header is none to refuse.
Result<CheckedImage> checkImage(std::span<const std::uint8_t> encoded, int maxSide, std::int64_t maxPixels);

/// 8-bit RGBA. Where its data are damaged or cut short, the rows that can't be read are as the format's usual decoder
/// leaves them: black and transparent, of a JPEG grey and opaque.
struct DecodedImage {
  Image image;
  std::string wrong; ///< with its data, in the decoder's words; empty = nothing
};
DecodedImage decodeImage(const CheckedImage& image);

/// Takes complete rows, 8-bit RGBA: those from row `first` on, the rows before it having been taken. They are gone when
/// it returns.
using TakeRows = std::function<void(int first, std::span<const std::uint8_t> rgba)>;

/// The same, `atOnce` rows at a time (a multiple of 16), at the end fewer; all at once where its file does not hold
/// them in order: interlaced PNGs and WebPs. Gives what is wrong with its data; empty = nothing.
std::string decodeRows(const CheckedImage& image, int atOnce, const TakeRows& take);

/// Both in turn; a problem where anything is wrong.
Result<Image> decodeImage(std::span<const std::uint8_t> encoded, int maxSide, std::int64_t maxPixels);

} // namespace gnomon
