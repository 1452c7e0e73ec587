#include "renderer/image/webp_decode.h"

#include <cstddef>
#include <webp/decode.h>

namespace gnomon {

std::string decodeWebp(EncodedBytes essential, DecodedRows& to) {
  const ImageSize& size = to.size();
  WebPBitstreamFeatures features;
  if (WebPGetFeatures(essential.data(), essential.size(), &features) != VP8_STATUS_OK || features.has_animation != 0 ||
      features.width != size.width || features.height != size.height) {
    return "its header contradicts itself";
  }
  const std::size_t bytes = to.rowBytes() * static_cast<std::size_t>(size.height);
  std::uint8_t* rgba = to.all();
  if (WebPDecodeRGBAInto(essential.data(), essential.size(), rgba, bytes, size.width * 4) == nullptr) {
    return "its pixels are damaged or missing";
  }
  if (features.has_alpha == 0) { // a lossless one may hold any alpha, which then means nothing
    for (std::size_t i = 3; i < bytes; i += 4) rgba[i] = 255;
  }
  to.complete(size.height);
  return {};
}

} // namespace gnomon
