#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "renderer/image/oiio/module.h"

namespace gnomon::codec {
namespace {

/// Spreads rows of 1 (grey), 2 (grey, alpha), 3 or 4 channels, packed at the front of `rgba`, to RGBA in place.
/// Backwards, so that no pixel is overwritten before it is read.
void spreadToRgba(std::uint8_t* rgba, std::size_t pixelCount, std::size_t channelCount) {
  for (std::size_t i = pixelCount; i-- > 0;) {
    const std::uint8_t* from = rgba + i * channelCount;
    const bool grey = channelCount < 3;
    const std::uint8_t red = from[0];
    const std::uint8_t green = grey ? red : from[1];
    const std::uint8_t blue = grey ? red : from[2];
    const std::uint8_t alpha = channelCount == 2 ? from[1] : channelCount == 4 ? from[3] : std::uint8_t{255};
    std::uint8_t* to = rgba + i * 4;
    to[0] = red;
    to[1] = green;
    to[2] = blue;
    to[3] = alpha;
  }
}

const char* readerOf(Format format) {
  switch (format) {
    case Format::png:
      return "png";
    case Format::jpeg:
      return "jpeg";
    case Format::webp:
      return "webp";
  }
  return "";
}

/// What the encoded bytes are read from. Must stay where it is.
struct OpenPicture {
  OIIO::Filesystem::IOMemReader memory;
  std::unique_ptr<OIIO::ImageInput> input;
  OIIO::ImageSpec spec{};

  OpenPicture(Format format, const std::uint8_t* encoded, std::size_t size)
      : memory(const_cast<std::uint8_t*>(encoded), size), input(OIIO::ImageInput::create(readerOf(format))) {}

  bool open(Format format, int width, int height, const Sink& message) {
    if (!input) return fail(message, OIIO::geterror());
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);
    if (!input->set_ioproxy(&memory) || !input->open(readerOf(format), spec, config)) {
      return fail(message, input->geterror());
    }
    const bool fits =
        spec.width == width && spec.height == height && spec.depth <= 1 && spec.nchannels >= 1 && spec.nchannels <= 4;
    return fits || fail(message, "its header contradicts itself");
  }

  /// The channels from `first` on, `pixelStride` bytes from one pixel to the next.
  bool read(int first, OIIO::stride_t pixelStride, std::uint8_t* pixels, const Sink& message) {
    const bool done = input->read_image(0, 0, first, spec.nchannels, OIIO::TypeUInt8, pixels, pixelStride);
    // A reader may note what went wrong and yet give rows.
    return (done && !input->has_error()) || fail(message, input->geterror());
  }
};

} // namespace

bool decode(Format format, const std::uint8_t* encoded, std::size_t size, int width, int height, std::uint8_t* rgba,
            const Sink& message) {
  return guarded(message, [&] {
    OpenPicture picture(format, encoded, size);
    if (!picture.open(format, width, height, message)) return false;
    if (!picture.read(0, OIIO::AutoStride, rgba, message)) return false;
    spreadToRgba(rgba, static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
                 static_cast<std::size_t>(picture.spec.nchannels));
    return true;
  });
}

bool decodeAlpha(Format format, const std::uint8_t* encoded, std::size_t size, int width, int height,
                 std::uint8_t* rgba, const Sink& message) {
  return guarded(message, [&] {
    OpenPicture picture(format, encoded, size);
    if (!picture.open(format, width, height, message)) return false;
    if (picture.spec.nchannels != 4) return fail(message, "it has no alpha");
    return picture.read(3, 4, rgba + 3, message);
  });
}

} // namespace gnomon::codec
