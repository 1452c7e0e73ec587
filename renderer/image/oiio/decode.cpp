#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <cstddef>
#include <cstdint>

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

} // namespace

bool decode(Format format, const std::uint8_t* encoded, std::size_t size, int width, int height, std::uint8_t* rgba,
            const Sink& message) {
  return guarded(message, [&] {
    const char* reader = format == Format::png ? "png" : "jpeg";
    const auto input = OIIO::ImageInput::create(reader);
    if (!input) return fail(message, OIIO::geterror());
    OIIO::Filesystem::IOMemReader memory(const_cast<std::uint8_t*>(encoded), size);
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);
    OIIO::ImageSpec spec;
    if (!input->set_ioproxy(&memory) || !input->open(reader, spec, config)) return fail(message, input->geterror());
    if (spec.width != width || spec.height != height || spec.depth > 1 || spec.nchannels < 1 || spec.nchannels > 4) {
      return fail(message, "its header contradicts itself");
    }
    if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeUInt8, rgba)) return fail(message, input->geterror());
    // A reader may note what went wrong and yet give rows.
    if (input->has_error()) return fail(message, input->geterror());
    spreadToRgba(rgba, static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
                 static_cast<std::size_t>(spec.nchannels));
    return true;
  });
}

} // namespace gnomon::codec
