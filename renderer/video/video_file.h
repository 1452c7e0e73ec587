#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "protocol/base/bytes.h"
#include "protocol/base/result.h"

struct vpx_codec_ctx;

/// VP9 in WebM (Matroska of RFC 9559), sent while it is made: the head, a cluster a frame, then a tag. The size of the
/// segment stays open, as in live streams. Debian installs libwebm without its muxer.
namespace gnomon {

/// The one track.
struct VideoTrack {
  int width = 0;               ///< pixels
  int height = 0;              ///< pixels
  double framesPerSecond = 30; ///< > 0
  int frames = 0;              ///< all of them: they give the duration
};

/// The bytes before the first frame. Colors: sRGB by BT.709's matrix, as encodeI420 gives them.
std::string webmHead(const VideoTrack& track);

/// Frame `index`, from 0. `isKey`: nothing before it is needed to decode it.
std::string webmFrame(const VideoTrack& track, int index, std::string_view vp9, bool isKey);

/// The bytes after the last frame: a named text about the whole file.
std::string webmTag(std::string_view name, std::string_view text);

struct Vp9Settings {
  int width = 0;               ///< pixels, 1..65536
  int height = 0;              ///< pixels, 1..65536
  double framesPerSecond = 30; ///< a frame that needs no other comes every two seconds
  int quality = 75;            ///< 1 smallest .. 100 best: the same for every frame, whatever size that gives
  int threads = 1;
};

struct Vp9Frame {
  Bytes bytes;
  bool isKey = false; ///< needs no other frame
};

/// VP9 by libvpx, as fast as that can: profile 0, 8 bits, 4:2:0, BT.709. One thread at a time.
class Vp9Encoder {
 public:
  static Result<Vp9Encoder> create(const Vp9Settings& settings);

  /// The next frame, from its planes as encodeI420 gives them. REQUIRES: planes of the settings' size.
  Result<Vp9Frame> encode(std::span<const std::uint8_t> planes);

 private:
  struct Destroy {
    void operator()(vpx_codec_ctx* context) const;
  };
  using Context = std::unique_ptr<vpx_codec_ctx, Destroy>;

  Vp9Encoder(Context context, int width, int height) : context_(std::move(context)), width_(width), height_(height) {}

  Context context_;
  int width_;
  int height_;
  std::int64_t next_ = 0; ///< frame
};

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
