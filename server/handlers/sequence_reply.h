#pragma once

#include <memory>
#include <optional>

#include "server/handlers/sequence_forms.h"
#include "server/handlers/sequence_frames.h"

namespace gnomon {

/// A reply that sends the frames while they are drawn, and at last the report or a problem. `first`: a frame that was
/// waited for. `report`: what it begins with.
HttpReply sequenceReply(TypedForm form, const RouteCall& call, std::shared_ptr<FrameSource> frames,
                        std::optional<DoneFrame> first, SequenceReport report);

} // namespace gnomon
