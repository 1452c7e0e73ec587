#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "protocol/base/bytes.h"
#include "protocol/base/result.h"

struct vpx_codec_ctx;

namespace gnomon {

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

} // namespace gnomon
