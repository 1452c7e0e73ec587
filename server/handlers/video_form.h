#pragma once

#include "protocol/base/result.h"
#include "server/handlers/sequence_forms.h"
#include "server/system/byte_budget.h"

namespace gnomon {

inline constexpr std::string_view kVideoType = "video/webm";

/// What a video is, beside its size.
struct VideoSettings {
  double framesPerSecond = 30;
  int quality = 75;
  int frames = 0;
};

/// A sequence as WebM of the size that its first frame has; its report, or its problem, is a tag at the end. Frames are
/// encoded where they are sent from, while workers draw the next ones. What that takes is held of `memory` as long as
/// the form lives: tooLarge where it never can be had, busy where others have it. REQUIRES: frames of kRawVideo.
Result<TypedForm> videoForm(const VideoSettings& settings, const DoneFrame& first, ByteBudget& memory,
                            const Holder& holder);

} // namespace gnomon
