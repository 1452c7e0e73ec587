#include <algorithm>
#include <array>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <libdeflate.h>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <tiffio.h>

#include "renderer/core/parallel.h"
#include "renderer/core/stop.h"
#include "renderer/image/deflate_stripe.h"
#include "renderer/image/image.h"
#include "renderer/image/picture_encode.h"

namespace gnomon {
namespace {

constexpr std::size_t kStripBytes = std::size_t{1} << 18; ///< about as many in a strip
constexpr std::size_t kStripsAtOnce = 64;                 ///< compressed before they are written
constexpr int kStripLevel = 2;                            ///< of deflateStripe: quick

/// A file in memory, and the first complaint about it.
struct MemoryFile {
  Bytes bytes;
  std::size_t at = 0;
  std::string message;
};

MemoryFile& memoryOf(thandle_t handle) {
  return *static_cast<MemoryFile*>(handle);
}

tmsize_t readFrom(thandle_t handle, void* data, tmsize_t size) {
  MemoryFile& file = memoryOf(handle);
  const std::size_t rest = file.bytes.size() - std::min(file.at, file.bytes.size());
  const std::size_t count = std::min(static_cast<std::size_t>(size), rest);
  if (count > 0) std::memcpy(data, file.bytes.data() + file.at, count);
  file.at += count;
  return static_cast<tmsize_t>(count);
}

tmsize_t writeTo(thandle_t handle, void* data, tmsize_t size) {
  MemoryFile& file = memoryOf(handle);
  const auto count = static_cast<std::size_t>(size);
  if (file.bytes.size() < file.at + count) file.bytes.resize(file.at + count);
  std::memcpy(file.bytes.data() + file.at, data, count);
  file.at += count;
  return size;
}

toff_t seekIn(thandle_t handle, toff_t offset, int whence) {
  MemoryFile& file = memoryOf(handle);
  const std::size_t from = whence == SEEK_SET ? 0 : whence == SEEK_CUR ? file.at : file.bytes.size();
  file.at = from + static_cast<std::size_t>(offset); // backwards, too: unsigned numbers wrap
  return file.at;
}

int closeNothing(thandle_t) {
  return 0;
}

toff_t memorySize(thandle_t handle) {
  return memoryOf(handle).bytes.size();
}

int keepMessage(TIFF*, void* file, const char*, const char* format, va_list values) {
  std::string& message = static_cast<MemoryFile*>(file)->message;
  std::array<char, 200> text{};
  std::vsnprintf(text.data(), text.size(), format, values);
  if (message.empty()) message = text.data();
  return 1; // said no further
}

using Tiff = std::unique_ptr<TIFF, decltype(&TIFFClose)>;

Tiff openTiff(MemoryFile& file) {
  const std::unique_ptr<TIFFOpenOptions, decltype(&TIFFOpenOptionsFree)> options(TIFFOpenOptionsAlloc(),
                                                                                 TIFFOpenOptionsFree);
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), keepMessage, &file);
  TIFFOpenOptionsSetWarningHandlerExtR(options.get(), keepMessage, &file);
  return {TIFFClientOpenExt("memory", "wl", &file, readFrom, writeTo, seekIn, closeNothing, memorySize, nullptr,
                            nullptr, options.get()),
          TIFFClose};
}

bool describe(TIFF* tiff, const Image& image, std::uint32_t rowsPerStrip) {
  const auto channels = static_cast<std::uint16_t>(image.channels.size());
  const std::uint16_t colors = channels >= 3 ? 3 : 1;
  const std::uint16_t others = hasAlpha(image) ? EXTRASAMPLE_ASSOCALPHA : EXTRASAMPLE_UNSPECIFIED;
  const std::vector<std::uint16_t> further(channels - colors, others);
  bool good = TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, static_cast<std::uint32_t>(image.width)) == 1;
  const auto set = [&](auto... values) { good = good && TIFFSetField(tiff, values...) == 1; };
  set(TIFFTAG_IMAGELENGTH, static_cast<std::uint32_t>(image.height));
  set(TIFFTAG_BITSPERSAMPLE, 32);
  set(TIFFTAG_SAMPLESPERPIXEL, static_cast<int>(channels));
  set(TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_IEEEFP);
  set(TIFFTAG_COMPRESSION, COMPRESSION_ADOBE_DEFLATE);
  set(TIFFTAG_PHOTOMETRIC, colors == 3 ? PHOTOMETRIC_RGB : PHOTOMETRIC_MINISBLACK);
  if (!further.empty()) set(TIFFTAG_EXTRASAMPLES, static_cast<int>(further.size()), further.data());
  set(TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
  set(TIFFTAG_ORIENTATION, ORIENTATION_TOPLEFT);
  set(TIFFTAG_ROWSPERSTRIP, rowsPerStrip);
  set(TIFFTAG_SOFTWARE, "Gnomon");
  return good;
}

/// RFC 1950.
Bytes zlibStream(std::span<const std::uint8_t> data) {
  Bytes stream{0x78, 0x01};
  const Bytes deflated = deflateStripe(data, kStripLevel);
  stream.insert(stream.end(), deflated.begin(), deflated.end());
  stream.insert(stream.end(), std::begin(kDeflateEnd), std::end(kDeflateEnd));
  const std::uint32_t sum = libdeflate_adler32(1, data.data(), data.size());
  for (int shift = 24; shift >= 0; shift -= 8) stream.push_back(static_cast<std::uint8_t>(sum >> shift));
  return stream;
}

bool writeStrips(TIFF* tiff, std::span<const std::uint8_t> pixels, std::size_t stripBytes) {
  const std::size_t count = (pixels.size() + stripBytes - 1) / stripBytes;
  for (std::size_t first = 0; first < count; first += kStripsAtOnce) {
    std::vector<Bytes> strips(std::min(kStripsAtOnce, count - first));
    forEach(strips.size(), [&](std::size_t i) {
      const std::size_t at = (first + i) * stripBytes;
      strips[i] = zlibStream(pixels.subspan(at, std::min(stripBytes, pixels.size() - at)));
    });
    for (std::size_t i = 0; i < strips.size(); ++i) {
      const auto size = static_cast<tmsize_t>(strips[i].size());
      if (TIFFWriteRawStrip(tiff, static_cast<std::uint32_t>(first + i), strips[i].data(), size) != size) return false;
    }
  }
  return true;
}

} // namespace

Result<Bytes> encodeTiff(const Image& image) {
  const auto* floats = pixelsAs<float>(image);
  if (!floats) return Problem{ProblemCode::internal, "", "A TIFF needs a float image of its own size."};
  const std::size_t row = static_cast<std::size_t>(image.width) * image.channels.size();
  constexpr std::size_t kMost = std::numeric_limits<std::uint32_t>::max() / 16 * 15; // deflate may add a little
  if (floats->size() * sizeof(float) > kMost) {
    return Problem{ProblemCode::tooLarge, "", "The picture is too large for a TIFF.", std::to_string(kMost) + " bytes",
                   std::to_string(floats->size() * sizeof(float)) + " bytes"};
  }
  const std::vector<float> own = hasAlpha(image) ? associated(image) : std::vector<float>{};
  const std::span<const float> numbers = own.empty() ? *floats : own;
  const std::size_t rows =
      std::clamp<std::size_t>(kStripBytes / (row * sizeof(float)), 1, static_cast<std::size_t>(image.height));

  MemoryFile file;
  Tiff tiff = openTiff(file);
  const std::span<const std::uint8_t> bytes(reinterpret_cast<const std::uint8_t*>(numbers.data()),
                                            numbers.size_bytes());
  const bool written = tiff && describe(tiff.get(), image, static_cast<std::uint32_t>(rows)) &&
                       writeStrips(tiff.get(), bytes, rows * row * sizeof(float)) &&
                       TIFFWriteDirectory(tiff.get()) == 1;
  tiff.reset();
  if (written && file.message.empty()) return std::move(file.bytes);
  return Problem{ProblemCode::internal, "", "The TIFF could not be written: " + file.message + "."};
}

} // namespace gnomon
