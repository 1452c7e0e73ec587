#include "renderer/image/webp_encode.h"

#include <string>
#include <webp/encode.h>

#include "renderer/core/stop.h"

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

} // namespace

Result<Bytes> encodeWebp(const Image& image, int quality) {
  static_assert(kMaxWebpSide == WEBP_MAX_DIMENSION);
  const auto* pixels = pixelsAs<std::uint8_t>(image);
  if (!pixels || !isPicture(image)) {
    return Problem{ProblemCode::internal, "", "A WebP needs an 8-bit image of 1, 3 or 4 channels.", "", ""};
  }
  if (image.width > kMaxWebpSide || image.height > kMaxWebpSide) {
    return Problem{ProblemCode::tooLarge, "", "The picture is too wide or too high for a WebP.",
                   std::to_string(kMaxWebpSide) + " pixels a side",
                   std::to_string(image.width) + "x" + std::to_string(image.height)};
  }
  WebPConfig config;
  Picture picture;
  if (!picture.isReady || WebPConfigPreset(&config, WEBP_PRESET_DEFAULT, static_cast<float>(quality)) == 0) {
    return Problem{ProblemCode::internal, "", "The WebP encoder is another version.", "", ""};
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

} // namespace gnomon
