#include "tests/renderer/video/decoded_video.h"

#include <cmath>
#include <vpx/vp8dx.h>
#include <vpx/vpx_decoder.h>

#include "renderer/image/picture_encode.h"

namespace gnomon {

VideoDecoder::VideoDecoder() : context_(std::make_unique<vpx_codec_ctx_t>()) {
  vpx_codec_dec_init(context_.get(), vpx_codec_vp9_dx(), nullptr, 0);
}

VideoDecoder::~VideoDecoder() {
  vpx_codec_destroy(context_.get());
}

std::optional<DecodedPicture> VideoDecoder::decode(std::span<const std::uint8_t> frame) {
  const auto size = static_cast<unsigned>(frame.size());
  if (vpx_codec_decode(context_.get(), frame.data(), size, nullptr, 0) != VPX_CODEC_OK) return std::nullopt;
  vpx_codec_iter_t place = nullptr;
  const vpx_image_t* image = vpx_codec_get_frame(context_.get(), &place);
  if (image == nullptr || image->fmt != VPX_IMG_FMT_I420) return std::nullopt;
  DecodedPicture picture{static_cast<int>(image->d_w), static_cast<int>(image->d_h), {}, image->cs, image->range};
  for (int plane = 0; plane < 3; ++plane) {
    const int width = plane == 0 ? picture.width : (picture.width + 1) / 2;
    const int height = plane == 0 ? picture.height : (picture.height + 1) / 2;
    for (int y = 0; y < height; ++y) {
      const std::uint8_t* const row = image->planes[plane] + static_cast<std::ptrdiff_t>(y) * image->stride[plane];
      picture.planes.insert(picture.planes.end(), row, row + width);
    }
  }
  return picture;
}

double psnr(std::span<const std::uint8_t> a, std::span<const std::uint8_t> b) {
  if (a.size() != b.size() || a.empty()) return 0;
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double difference = double(a[i]) - double(b[i]);
    sum += difference * difference;
  }
  return sum == 0 ? 100 : 10 * std::log10(255.0 * 255.0 * static_cast<double>(a.size()) / sum);
}

Bytes movingPattern(int width, int height, int frame) {
  Image image{width, height, {"R", "G", "B"}, {}};
  std::vector<std::uint8_t> pixels;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double wave = std::sin((x + 3 * frame) * 0.09) + std::cos(y * 0.07);
      pixels.push_back(static_cast<std::uint8_t>(128 + 50 * wave));
      pixels.push_back(static_cast<std::uint8_t>(x * 255 / width));
      pixels.push_back(static_cast<std::uint8_t>(y * 255 / height));
    }
  }
  image.pixels = std::move(pixels);
  return *encodeI420(image);
}

} // namespace gnomon
