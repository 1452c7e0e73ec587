#include "renderer/video/video_file.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vpx/vp8cx.h>
#include <vpx/vpx_encoder.h>

#include "renderer/core/parallel.h"

namespace gnomon {

namespace {

std::size_t planesBytes(int width, int height) {
  const auto w = static_cast<std::size_t>(width);
  const auto h = static_cast<std::size_t>(height);
  return w * h + 2 * ((w + 1) / 2) * ((h + 1) / 2);
}

std::string sizeText(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

/// Half of the cores: frames are drawn meanwhile. More than four gain nothing at common sizes.
int encoderThreads() {
  constexpr int kMost = 4;
  return std::clamp(coresToUse() / 2, 1, kMost);
}

constexpr int kSpeed = 7; ///< of 5 best .. 9 fastest, for encoding in real time
constexpr double kSecondsBetweenKeys = 2;

/// libvpx's quantizer, 0 finest .. 63 coarsest, whose first steps only make files large.
unsigned quantizerOf(int quality) {
  constexpr double kFinest = 4, kCoarsest = 63;
  return static_cast<unsigned>(std::lround(kCoarsest - (quality - 1) * (kCoarsest - kFinest) / 99));
}

Problem failed(const char* what, vpx_codec_ctx_t* context) {
  const char* const why = context != nullptr ? vpx_codec_error_detail(context) : nullptr;
  return {ProblemCode::internal, "", what, "", why != nullptr ? why : ""};
}

/// Only what is not as usual.
bool configure(vpx_codec_enc_cfg_t& config, const Vp9Settings& settings) {
  if (vpx_codec_enc_config_default(vpx_codec_vp9_cx(), &config, 0) != VPX_CODEC_OK) return false;
  config.g_w = static_cast<unsigned>(settings.width);
  config.g_h = static_cast<unsigned>(settings.height);
  config.g_timebase = {1'000, static_cast<int>(std::lround(settings.framesPerSecond * 1'000))};
  config.g_threads = static_cast<unsigned>(settings.threads);
  config.g_lag_in_frames = 0; // each frame comes out as it goes in
  config.rc_end_usage = VPX_Q;
  config.rc_min_quantizer = config.rc_max_quantizer = quantizerOf(settings.quality);
  config.kf_max_dist = static_cast<unsigned>(std::max(1L, std::lround(settings.framesPerSecond * kSecondsBetweenKeys)));
  return true;
}

bool control(vpx_codec_ctx_t* context, int quality) {
  constexpr int kTileColumnsLog2 = 2; // as many as are wide enough
  return vpx_codec_control(context, VP8E_SET_CPUUSED, kSpeed) == VPX_CODEC_OK &&
         vpx_codec_control(context, VP8E_SET_CQ_LEVEL, quantizerOf(quality)) == VPX_CODEC_OK &&
         vpx_codec_control(context, VP9E_SET_TILE_COLUMNS, kTileColumnsLog2) == VPX_CODEC_OK &&
         vpx_codec_control(context, VP9E_SET_ROW_MT, 1u) == VPX_CODEC_OK &&
         vpx_codec_control(context, VP9E_SET_COLOR_SPACE, VPX_CS_BT_709) == VPX_CODEC_OK &&
         vpx_codec_control(context, VP9E_SET_COLOR_RANGE, VPX_CR_STUDIO_RANGE) == VPX_CODEC_OK;
}

/// The planes, seen as libvpx sees them, which does not write to what it encodes.
vpx_image_t imageOf(std::span<const std::uint8_t> planes, int width, int height) {
  vpx_image_t image{};
  auto* const bytes = const_cast<std::uint8_t*>(planes.data());
  vpx_img_wrap(&image, VPX_IMG_FMT_I420, static_cast<unsigned>(width), static_cast<unsigned>(height), 1, bytes);
  const int halfWidth = (width + 1) / 2;
  const int halfHeight = (height + 1) / 2;
  image.planes[VPX_PLANE_Y] = bytes;
  image.planes[VPX_PLANE_U] = bytes + static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  image.planes[VPX_PLANE_V] =
      image.planes[VPX_PLANE_U] + static_cast<std::size_t>(halfWidth) * static_cast<std::size_t>(halfHeight);
  image.stride[VPX_PLANE_Y] = width;
  image.stride[VPX_PLANE_U] = image.stride[VPX_PLANE_V] = halfWidth;
  image.cs = VPX_CS_BT_709;
  image.range = VPX_CR_STUDIO_RANGE;
  return image;
}

} // namespace

std::size_t videoBytes(int width, int height) {
  constexpr std::size_t kFixed = 32u << 20;
  constexpr std::size_t kBlock = 64;   ///< pixels a side of what is encoded at a time
  constexpr std::size_t kBorder = 320; ///< pixels around each picture that is kept, both sides together
  constexpr std::size_t kCoding = 60;  ///< bytes a pixel of whole blocks: what is found about them, tokens, the file
  constexpr std::size_t kKept = 15;    ///< bytes a pixel: pictures that later ones refer to
  const auto w = static_cast<std::size_t>(width);
  const auto h = static_cast<std::size_t>(height);
  const auto whole = [](std::size_t side) { return (side + kBlock - 1) / kBlock * kBlock; };
  return kFixed + kCoding * whole(w) * whole(h) + kKept * (w + kBorder) * (h + kBorder);
}

Result<VideoFile> VideoFile::create(const VideoTrack& track, int quality) {
  auto encoder = Vp9Encoder::create({.width = track.width,
                                     .height = track.height,
                                     .framesPerSecond = track.framesPerSecond,
                                     .quality = quality,
                                     .threads = encoderThreads()});
  if (!encoder) return encoder.problems();
  return VideoFile(track, *std::move(encoder));
}

Result<std::string> VideoFile::add(const VideoPicture& picture) {
  if (picture.width != track_.width || picture.height != track_.height) {
    return Problem{ProblemCode::invalidValue, "", "All frames of a video have the size of its first.",
                   sizeText(track_.width, track_.height), sizeText(picture.width, picture.height)};
  }
  if (picture.planes.size() != planesBytes(picture.width, picture.height)) {
    return Problem{ProblemCode::internal, "", "A picture has too few or too many bytes."};
  }
  const auto frame = encoder_.encode(picture.planes);
  if (!frame) return frame.problems();
  return webmFrame(track_, next_++, asText(frame->bytes), frame->isKey);
}

void Vp9Encoder::Destroy::operator()(vpx_codec_ctx* context) const {
  vpx_codec_destroy(context);
  delete context;
}

Result<Vp9Encoder> Vp9Encoder::create(const Vp9Settings& settings) {
  vpx_codec_enc_cfg_t config{};
  if (!configure(config, settings)) return failed("The VP9 encoder is another version.", nullptr);
  auto opened = std::make_unique<vpx_codec_ctx_t>();
  if (vpx_codec_enc_init(opened.get(), vpx_codec_vp9_cx(), &config, 0) != VPX_CODEC_OK) {
    return failed("The VP9 encoder could not be started.", opened.get());
  }
  Context context(opened.release());
  if (!control(context.get(), settings.quality)) return failed("The VP9 encoder lacks a setting.", context.get());
  return Vp9Encoder(std::move(context), settings.width, settings.height);
}

Result<Vp9Frame> Vp9Encoder::encode(std::span<const std::uint8_t> planes) {
  const vpx_image_t image = imageOf(planes, width_, height_);
  if (vpx_codec_encode(context_.get(), &image, next_++, 1, 0, VPX_DL_REALTIME) != VPX_CODEC_OK) {
    return failed("A frame could not be encoded.", context_.get());
  }
  Vp9Frame frame;
  vpx_codec_iter_t place = nullptr;
  while (const vpx_codec_cx_pkt_t* packet = vpx_codec_get_cx_data(context_.get(), &place)) {
    if (packet->kind != VPX_CODEC_CX_FRAME_PKT) continue;
    const auto* const bytes = static_cast<const std::uint8_t*>(packet->data.frame.buf);
    frame.bytes.insert(frame.bytes.end(), bytes, bytes + packet->data.frame.sz);
    frame.isKey = (packet->data.frame.flags & VPX_FRAME_IS_KEY) != 0;
  }
  if (frame.bytes.empty()) return failed("The VP9 encoder left a frame out.", context_.get());
  return frame;
}

} // namespace gnomon
