#include <algorithm>
#include <cstddef>
#include <cstring>
#include <memory>
#include <new>
#include <webp/decode.h>

#include "renderer/image/picture_decode.h"

namespace gnomon {

namespace {

/// The rows that there are, as far as the data goes; how many.
int decodeBeginning(EncodedBytes essential, DecodedRows& to, std::size_t bytes) {
  const std::unique_ptr<WebPIDecoder, decltype(&WebPIDelete)> decoder(
      WebPINewRGB(MODE_RGBA, to.all(), bytes, to.size().width * 4), WebPIDelete);
  if (!decoder) throw std::bad_alloc();
  WebPIUpdate(decoder.get(), essential.data(), essential.size());
  int rows = 0;
  const bool some = WebPIDecGetRGB(decoder.get(), &rows, nullptr, nullptr, nullptr) != nullptr;
  return some ? std::clamp(rows, 0, to.size().height) : 0;
}

} // namespace

std::string decodeWebp(EncodedBytes essential, DecodedRows& to) {
  const ImageSize& size = to.size();
  WebPBitstreamFeatures features;
  if (WebPGetFeatures(essential.data(), essential.size(), &features) != VP8_STATUS_OK || features.has_animation != 0 ||
      features.width != size.width || features.height != size.height) {
    std::memset(to.all(), 0, to.rowBytes() * static_cast<std::size_t>(size.height));
    to.complete(size.height);
    return "its header contradicts itself";
  }
  const std::size_t bytes = to.rowBytes() * static_cast<std::size_t>(size.height);
  std::uint8_t* rgba = to.all();
  const bool whole = WebPDecodeRGBAInto(essential.data(), essential.size(), rgba, bytes, size.width * 4) != nullptr;
  const int rows = whole ? size.height : decodeBeginning(essential, to, bytes);
  const std::size_t read = to.rowBytes() * static_cast<std::size_t>(rows);
  std::memset(rgba + read, 0, bytes - read);
  if (features.has_alpha == 0) { // a lossless one may hold any alpha, which then means nothing
    for (std::size_t i = 3; i < read; i += 4) rgba[i] = 255;
  }
  to.complete(size.height);
  return whole ? "" : "its pixels are damaged or missing";
}

} // namespace gnomon
