#include "renderer/video/video_file.h"

#include <algorithm>
#include <utility>

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
    return Problem{ProblemCode::internal, "", "A picture has too few or too many bytes.", "", ""};
  }
  const auto frame = encoder_.encode(picture.planes);
  if (!frame) return frame.problems();
  return webmFrame(track_, next_++, asText(frame->bytes), frame->isKey);
}

} // namespace gnomon
