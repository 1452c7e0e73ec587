#pragma once

#include <optional>
#include <span>
#include <vector>
#include <vpx/vpx_image.h>

#include "protocol/base/bytes.h"

struct vpx_codec_ctx;

namespace gnomon {

/// A picture that libvpx decoded, with planes as encodeI420 gives them.
struct DecodedPicture {
  int width = 0;
  int height = 0;
  Bytes planes;
  vpx_color_space space{};
  vpx_color_range range{};
};

/// Decodes VP9, frame by frame.
class VideoDecoder {
 public:
  VideoDecoder();
  ~VideoDecoder();
  VideoDecoder(const VideoDecoder&) = delete;
  VideoDecoder& operator=(const VideoDecoder&) = delete;

  /// Nothing where the frame is broken.
  std::optional<DecodedPicture> decode(std::span<const std::uint8_t> frame);

 private:
  std::unique_ptr<vpx_codec_ctx> context_;
};

/// Peak signal to noise ratio of bytes, in decibels; 100 where they are equal.
double psnr(std::span<const std::uint8_t> a, std::span<const std::uint8_t> b);

/// The planes of a soft pattern that moves by some pixels each frame.
Bytes movingPattern(int width, int height, int frame);

} // namespace gnomon
