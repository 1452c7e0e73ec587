#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "protocol/base/result.h"
#include "renderer/video/vp9_encoder.h"
#include "renderer/video/webm.h"

namespace gnomon {

/// A picture as encodeI420 gives it.
struct VideoPicture {
  int width = 0;  ///< pixels
  int height = 0; ///< pixels
  std::span<const std::uint8_t> planes{};
};

/// What making a video of this size takes in memory, at most, its pictures not counted.
std::size_t videoBytes(int width, int height);

/// A WebM of VP9, to be sent or written while its pictures come: the head, a piece for each picture, and an end.
class VideoFile {
 public:
  /// `quality`: 1 smallest .. 100 best. REQUIRES: sides of 1..65535.
  static Result<VideoFile> create(const VideoTrack& track, int quality);

  std::string head() const { return webmHead(track_); }

  /// The next picture. A problem of code invalidValue where it has another size than the track.
  Result<std::string> add(const VideoPicture& picture);

 private:
  VideoFile(const VideoTrack& track, Vp9Encoder encoder) : track_(track), encoder_(std::move(encoder)) {}

  VideoTrack track_;
  Vp9Encoder encoder_;
  int next_ = 0; ///< picture
};

} // namespace gnomon
