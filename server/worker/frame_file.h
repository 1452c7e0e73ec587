#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "renderer/render.h"

namespace gnomon {

/// A frame as it is sent.
struct FrameFile {
  std::string contentType;
  std::string body;
  std::vector<StageTime> stages;       ///< of the frame, with `encode`
  std::vector<std::string> warnings{}; ///< of its report
};

/// Encodes the frame and adds the stage `encode` to its report. `format`: of its pictures. `mediaType`: theirs, for one
/// file of the first view or, as the format has it, of all; multipart/mixed, whose parts `boundary` separates, which
/// must not occur in a picture by chance; or application/json. `goOn`: as encodePictures takes it.
Result<FrameFile> frameFile(Frame frame, ImageFormat format, std::string_view mediaType, std::string_view boundary,
                            const GoOn& goOn);

} // namespace gnomon
