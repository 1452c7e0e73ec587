#pragma once

#include <string_view>

#include "protocol/base/result.h"
#include "renderer/render.h"
#include "server/http/http_reply.h"
#include "server/http/negotiation.h"

namespace gnomon {

/// Encodes the frame in the form asked for, adds the stage `encode` to its report, and tells every stage in
/// Server-Timing. `boundary` separates the parts of a multipart reply; it must not occur in a picture by chance.
Result<HttpReply> frameReply(Frame frame, FrameForm form, std::string_view boundary);

/// "queue;dur=0.12, load;dur=3.4": the value of a Server-Timing header.
std::string serverTiming(const std::vector<StageTime>& stages);

} // namespace gnomon
