#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/base/bytes.h"
#include "protocol/base/result.h"
#include "protocol/spec/output_options.h"
#include "renderer/image/image.h"
#include "renderer/image/image_codec.h"

/// Encoders. PNGs are made by stripes: runs of rows filtered and compressed independently, by all cores, to the same
/// bytes.
namespace gnomon {

struct PngFormat {
  int width = 1;
  int height = 1;
  int channelCount = 3; ///< 1 grey, 3 RGB, 4 RGB and straight alpha
  int level = 2;        ///< 0 fastest .. 9 smallest
  int bits = 8;         ///< of a channel: 8 or 16

  std::size_t pixelBytes() const { return static_cast<std::size_t>(channelCount * bits / 8); }
  std::size_t rowBytes() const { return static_cast<std::size_t>(width) * pixelBytes(); }
  std::size_t stripeRows() const; ///< of every stripe but the last, which has what is left
  std::size_t stripeCount() const;
};

/// One stripe as it is in the file.
struct PngStripe {
  Bytes chunk;             ///< an IDAT chunk
  std::uint32_t adler = 1; ///< Adler-32 of the filtered rows
  std::size_t filteredBytes = 0;
};

/// `rows`: those of this stripe, interleaved, first row on top; of 16 bits the higher byte first.
PngStripe pngStripe(const PngFormat& format, std::span<const std::uint8_t> rows);

/// The file. REQUIRES: all stripes of the picture, from the top down.
Bytes assemblePng(const PngFormat& format, std::span<const PngStripe> stripes);

/// A PNG of an image of 8 or 16 bits and 1, 3 or 4 channels, by all cores. level 0..9.
Result<Bytes> encodePng(const Image& image, int level);

/// A JPEG (4:4:4) of an 8-bit image: one channel grey, three RGB; a fourth is left out. `quality`: 1 smallest .. 100
/// best.
Result<Bytes> encodeJpeg(const Image& image, int quality);

/// Pixels along a side of a WebP, at most.
inline constexpr int kMaxWebpSide = 16383;

/// A lossy WebP of an 8-bit image of 1, 3 or 4 channels, straight alpha kept exactly. `quality`: 0 smallest .. 100
/// best. tooLarge where a side is longer than kMaxWebpSide.
Result<Bytes> encodeWebp(const Image& image, int quality);

/// A TIFF of a float image, 32 bits a channel, in deflated strips; three channels are RGB, others grey and further
/// numbers; color is multiplied by alpha. tooLarge from 4 GiB on.
Result<Bytes> encodeTiff(const Image& image);

/// What the floats of an image are in an array.
enum class ArrayNumbers {
  float32,
  int32 ///< whole numbers
};

/// An array for NumPy (NPY 1.0), C order: rows, columns and, of several, channels; uint8 of an 8-bit image, `numbers`
/// of floats, little endian, color multiplied by alpha.
Result<Bytes> encodeNpy(const Image& image, ArrayNumbers numbers);

/// A ZIP, file by file, deflated by all cores or stored where that is smaller, with a pinned time; without ZIP64.
class ZipWriter {
 public:
  /// `name`: ASCII, none twice. A problem of code tooLarge where the ZIP would need ZIP64.
  Status add(std::string_view name, std::span<const std::uint8_t> content);

  /// The whole; the last call.
  Result<Bytes> finish() &&;

 private:
  Bytes file_;
  std::string directory_;
  std::size_t files_ = 0;
};

/// The planes Y', Cb and Cr of BT.709 of an 8-bit sRGB image of 1, 3 or 4 channels, one after the other: Y' 16..235,
/// the others 16..240 around 128 at half the size, rounded up; a fourth channel is left out.
Result<Bytes> encodeI420(const Image& image);

/// One layer of an EXR: its channels are written as "name.channel"; an empty name leaves the channel names alone.
struct ImageLayer {
  std::string name;
  const Image* image = nullptr;
  bool wide = false; ///< always floats
};

/// One part of an EXR: the layers of one size, side by side.
struct ExrPart {
  std::string name; ///< of its first layer; "main" where that has none
  int width = 0;
  int height = 0;
  std::vector<std::string> channels; ///< full names: "layer.channel"
  std::vector<bool> half;            ///< per channel; otherwise float
  std::vector<float> pixels;         ///< interleaved, first row on top
};

/// Groups layers into parts, in the order in which their sizes first appear; color is multiplied by its alpha, and Z
/// and id stay float.
Result<std::vector<ExrPart>> exrParts(std::span<const ImageLayer> layers, ExrPixelType pixelType);

/// An EXR of a float image per layer: layers of one size share a part, and the first one's size is the display window.
/// Color is multiplied by its alpha; Z is always float.
Result<Bytes> encodeExr(std::span<const ImageLayer> layers, ExrCompression compression, ExrPixelType pixelType);

} // namespace gnomon
