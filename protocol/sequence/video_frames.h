#pragma once

#include <optional>

#include "protocol/base/result.h"
#include "protocol/sequence/sequence_json.h"

namespace gnomon {

/// The frame as a video needs it: the first view alone, as it is seen, in 8 bits.
FrameSpec videoFrame(FrameSpec spec);

/// Whether all frames of a sequence have one size, as a video must.
class FrameSizes {
 public:
  /// Each frame in order, as decodeSequence calls for them.
  void see(const FrameSpec& spec);

  /// The first frame of another size, with its place. Views that choose their own size are found by their pictures.
  std::optional<Problem> problem(const Sequence& sequence) const;

 private:
  int width_ = 0;
  int height_ = 0;
  int seen_ = 0; ///< frames
  struct Other {
    int number, width, height;
  };
  std::optional<Other> other_{};
};

} // namespace gnomon
