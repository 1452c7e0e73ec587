#include <algorithm>
#include <array>
#include <libdeflate.h>
#include <string>
#include <string_view>
#include <zlib.h>

#include "renderer/core/instruction_sets.h"
#include "renderer/core/parallel.h"
#include "renderer/core/vectors.h"
#include "renderer/image/deflate_stripe.h"
#include "renderer/image/image_container.h"
#include "renderer/image/picture_encode.h"

namespace gnomon {
namespace {

using Row = std::span<const std::uint8_t>;

constexpr std::uint8_t kNone = 0, kSub = 1, kUp = 2; ///< filter types, PNG specification, section 9

constexpr std::array<std::uint8_t, 2> kZlibHeader{0x78, 0x01}; ///< RFC 1950: deflate with a window of 32 KiB

// What the numbers mean: sRGB, absolute colorimetric; and the same for readers that do not know the sRGB chunk.
constexpr std::array<std::uint8_t, 4> kGamma{0x00, 0x00, 0xb1, 0x8f};
constexpr std::array<std::uint8_t, 1> kIntent{3};
constexpr std::array<std::uint8_t, 32> kPrimaries{0,    0,    0x7a, 0x26, 0,    0,    0x80, 0x84, 0,    0,   0xfa,
                                                  0x00, 0,    0,    0x80, 0xe8, 0,    0,    0x75, 0x30, 0,   0,
                                                  0xea, 0x60, 0,    0,    0x3a, 0x98, 0,    0,    0x17, 0x70};

/// A stripe becomes one chunk, whose length has 31 bits.
constexpr std::size_t kMaxStripeBytes = std::size_t{1} << 30;

std::array<std::uint8_t, 4> bigEndianBytes(std::uint32_t value) {
  return {static_cast<std::uint8_t>(value >> 24), static_cast<std::uint8_t>(value >> 16),
          static_cast<std::uint8_t>(value >> 8), static_cast<std::uint8_t>(value)};
}

void append(Bytes& bytes, Row more) {
  bytes.insert(bytes.end(), more.begin(), more.end());
}

void appendChunk(Bytes& file, std::string_view type, Row data) {
  append(file, bigEndianBytes(static_cast<std::uint32_t>(data.size())));
  const std::size_t checked = file.size();
  file.insert(file.end(), type.begin(), type.end());
  append(file, data);
  append(file, bigEndianBytes(libdeflate_crc32(0, file.data() + checked, file.size() - checked)));
}

/// Of a difference modulo 256, the distance from 0.
std::uint8_t size(std::uint8_t difference) {
  return std::min(difference, static_cast<std::uint8_t>(-difference));
}

/// The sum of the differences' sizes between two rows of samples.
GNOMON_FOR_EACH_INSTRUCTION_SET std::uint64_t distance(const std::uint8_t* a, const std::uint8_t* b,
                                                       std::size_t count) {
  constexpr std::size_t kAtOnce = 256; // sizes, up to 128 each, whose sum has 16 bits
  std::uint64_t sum = 0;
  std::size_t done = 0;
  for (; done + kAtOnce <= count; done += kAtOnce) {
    std::uint16_t part = 0;
    for (std::size_t i = 0; i < kAtOnce; ++i) {
      part = static_cast<std::uint16_t>(part + size(static_cast<std::uint8_t>(a[done + i] - b[done + i])));
    }
    sum += part;
  }
  for (; done < count; ++done) sum += size(static_cast<std::uint8_t>(a[done] - b[done]));
  return sum;
}

GNOMON_FOR_EACH_INSTRUCTION_SET void subtract(const std::uint8_t* a, const std::uint8_t* b, std::size_t count,
                                              std::uint8_t* differences) {
  for (std::size_t i = 0; i < count; ++i) differences[i] = static_cast<std::uint8_t>(a[i] - b[i]);
}

/// The row's filter type (of Sub and Up the one with the smaller sum of absolute differences) and its filtered samples.
/// `above`: the row above within the stripe, or null. `pixel`: bytes.
void filterRow(Row row, const std::uint8_t* above, std::size_t pixel, bool filtering, std::uint8_t* filtered) {
  const std::uint8_t* samples = row.data();
  const std::size_t rest = row.size() - pixel;
  if (!filtering) {
    filtered[0] = kNone;
    std::copy(row.begin(), row.end(), filtered + 1);
    return;
  }
  const auto bySub = [&] { return distance(samples + pixel, samples, rest); };
  if (above && distance(samples + pixel, above + pixel, rest) <= bySub()) {
    filtered[0] = kUp;
    subtract(samples, above, row.size(), filtered + 1);
    return;
  }
  filtered[0] = kSub;
  std::copy_n(samples, pixel, filtered + 1);
  subtract(samples + pixel, samples, rest, filtered + 1 + pixel);
}

UnfilledVector<std::uint8_t> filteredRows(const PngFormat& format, Row rows) {
  const std::size_t rowBytes = format.rowBytes();
  const std::size_t count = rows.size() / rowBytes;
  UnfilledVector<std::uint8_t> filtered(count * (rowBytes + 1));
  for (std::size_t y = 0; y < count; ++y) {
    const Row row = rows.subspan(y * rowBytes, rowBytes);
    filterRow(row, y == 0 ? nullptr : row.data() - rowBytes, format.pixelBytes(), format.level > 0,
              filtered.data() + y * (rowBytes + 1));
  }
  return filtered;
}

Bytes headerOf(const PngFormat& format) {
  constexpr std::uint8_t kGrey = 0, kRgb = 2, kRgba = 6; // color types
  Bytes header;
  append(header, bigEndianBytes(static_cast<std::uint32_t>(format.width)));
  append(header, bigEndianBytes(static_cast<std::uint32_t>(format.height)));
  const std::uint8_t colorType = format.channelCount == 1 ? kGrey : format.channelCount == 3 ? kRgb : kRgba;
  append(header, std::array<std::uint8_t, 5>{static_cast<std::uint8_t>(format.bits), colorType, 0, 0, 0});
  return header;
}

/// The stripe of the pixels first..last.
PngStripe stripeOf(const PngFormat& format, const std::vector<std::uint8_t>& pixels, std::size_t first,
                   std::size_t last) {
  return pngStripe(format, Row(pixels).subspan(first, last - first));
}

PngStripe stripeOf(const PngFormat& format, const std::vector<std::uint16_t>& pixels, std::size_t first,
                   std::size_t last) {
  Bytes rows;
  rows.reserve(2 * (last - first));
  for (std::size_t i = first; i < last; ++i) {
    rows.push_back(static_cast<std::uint8_t>(pixels[i] >> 8));
    rows.push_back(static_cast<std::uint8_t>(pixels[i]));
  }
  return pngStripe(format, rows);
}

template <class Number>
Result<Bytes> encodePixels(const PngFormat& format, const std::vector<Number>& pixels) {
  if (format.rowBytes() * format.stripeRows() > kMaxStripeBytes) {
    return Problem{ProblemCode::internal, "", "The image is too wide for a PNG."};
  }
  const std::size_t stripe = format.rowBytes() / sizeof(Number) * format.stripeRows();
  std::vector<PngStripe> stripes(format.stripeCount());
  forEachPiece(pixels.size(), stripe, [&](std::size_t first, std::size_t last) {
    stripes[first / stripe] = stripeOf(format, pixels, first, last);
  });
  return assemblePng(format, stripes);
}

} // namespace

std::size_t PngFormat::stripeRows() const {
  // Higher stripes compress better, by 1 to 3 %, and occupy fewer cores.
  return level < 3 ? 16 : level < 8 ? 32 : 64;
}

std::size_t PngFormat::stripeCount() const {
  return (static_cast<std::size_t>(height) + stripeRows() - 1) / stripeRows();
}

PngStripe pngStripe(const PngFormat& format, std::span<const std::uint8_t> rows) {
  const auto filtered = filteredRows(format, rows);
  PngStripe stripe;
  stripe.adler = libdeflate_adler32(1, filtered.data(), filtered.size());
  stripe.filteredBytes = filtered.size();
  appendChunk(stripe.chunk, "IDAT", deflateStripe(filtered, format.level));
  return stripe;
}

Bytes assemblePng(const PngFormat& format, std::span<const PngStripe> stripes) {
  constexpr std::size_t kOtherChunks = 256; // more than they take
  std::size_t size = kOtherChunks;
  for (const PngStripe& stripe : stripes) size += stripe.chunk.size();
  Bytes file(kPngSignature.begin(), kPngSignature.end());
  file.reserve(size);
  appendChunk(file, "IHDR", headerOf(format));
  appendChunk(file, "gAMA", kGamma);
  appendChunk(file, "sRGB", kIntent);
  appendChunk(file, "cHRM", kPrimaries);
  appendChunk(file, "IDAT", kZlibHeader);
  std::uint32_t adler = 1;
  for (const PngStripe& stripe : stripes) {
    append(file, stripe.chunk);
    adler =
        static_cast<std::uint32_t>(adler32_combine(adler, stripe.adler, static_cast<z_off_t>(stripe.filteredBytes)));
  }
  Bytes ending(std::begin(kDeflateEnd), std::end(kDeflateEnd));
  append(ending, bigEndianBytes(adler));
  appendChunk(file, "IDAT", ending);
  appendChunk(file, "IEND", {});
  return file;
}

Result<Bytes> encodePng(const Image& image, int level) {
  const auto* bytes = pixelsAs<std::uint8_t>(image);
  const auto* words = pixelsAs<std::uint16_t>(image);
  if ((!bytes && !words) || !isPicture(image)) {
    return Problem{ProblemCode::internal, "", "A PNG needs an image of 8 or 16 bits and 1, 3 or 4 channels."};
  }
  if (level < 0 || level > 9) {
    return Problem{ProblemCode::invalidValue, "", "The PNG compression level is out of range.", "0..9",
                   std::to_string(level)};
  }
  const PngFormat format{image.width, image.height, static_cast<int>(image.channels.size()), level, words ? 16 : 8};
  return words ? encodePixels(format, *words) : encodePixels(format, *bytes);
}

} // namespace gnomon
