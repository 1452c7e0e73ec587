#include <algorithm>
#include <cstddef>
#include <cstring>
#include <memory>
#include <new>
#include <string>
#include <webp/decode.h>
#include <webp/encode.h>

#include "renderer/core/stop.h"
#include "renderer/image/picture_decode.h"
#include "renderer/image/picture_encode.h"

namespace gnomon {

namespace {

constexpr int kMethod = 2; ///< 0 fastest .. 6 smallest

struct Picture : WebPPicture {
  Picture() : WebPPicture() { isReady = WebPPictureInit(this) != 0; }
  Picture(const Picture&) = delete;
  Picture& operator=(const Picture&) = delete;
  ~Picture() { WebPPictureFree(this); }

  bool isReady = false;
};

int appendTo(const std::uint8_t* data, std::size_t size, const WebPPicture* picture) {
  auto& file = *static_cast<Bytes*>(picture->custom_ptr);
  file.insert(file.end(), data, data + size);
  return 1;
}

/// 0 ends the encoding.
int goesOn(int, const WebPPicture*) {
  Stop* const stop = Stop::current();
  return stop == nullptr || !stop->asked() ? 1 : 0;
}

std::vector<std::uint8_t> rgbOf(const std::vector<std::uint8_t>& grey) {
  std::vector<std::uint8_t> rgb(grey.size() * 3);
  for (std::size_t i = 0; i < rgb.size(); ++i) rgb[i] = grey[i / 3];
  return rgb;
}

bool take(Picture& picture, const std::vector<std::uint8_t>& pixels, std::size_t channels) {
  if (channels == 4) return WebPPictureImportRGBA(&picture, pixels.data(), picture.width * 4) != 0;
  if (channels == 3) return WebPPictureImportRGB(&picture, pixels.data(), picture.width * 3) != 0;
  return WebPPictureImportRGB(&picture, rgbOf(pixels).data(), picture.width * 3) != 0;
}

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

Result<Bytes> encodeWebp(const Image& image, int quality) {
  static_assert(kMaxWebpSide == WEBP_MAX_DIMENSION);
  const auto* pixels = pixelsAs<std::uint8_t>(image);
  if (!pixels || !isPicture(image)) {
    return Problem{ProblemCode::internal, "", "A WebP needs an 8-bit image of 1, 3 or 4 channels."};
  }
  if (image.width > kMaxWebpSide || image.height > kMaxWebpSide) {
    return Problem{ProblemCode::tooLarge, "", "The picture is too wide or too high for a WebP.",
                   std::to_string(kMaxWebpSide) + " pixels a side",
                   std::to_string(image.width) + "x" + std::to_string(image.height)};
  }
  WebPConfig config;
  Picture picture;
  if (!picture.isReady || WebPConfigPreset(&config, WEBP_PRESET_DEFAULT, static_cast<float>(quality)) == 0) {
    return Problem{ProblemCode::internal, "", "The WebP encoder is another version."};
  }
  config.method = kMethod;
  Bytes file;
  picture.width = image.width;
  picture.height = image.height;
  picture.writer = appendTo;
  picture.custom_ptr = &file;
  picture.progress_hook = goesOn;
  stopIfAsked();
  if (take(picture, *pixels, image.channels.size()) && WebPEncode(&config, &picture) != 0) return file;
  stopIfAsked();
  return Problem{ProblemCode::internal, "", "The WebP could not be written.", "", std::to_string(picture.error_code)};
}

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
