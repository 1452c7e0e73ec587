#pragma once

#include <array>
#include <memory>
#include <string>
#include <string_view>

#include "server/handlers/sequence_frames.h"
#include "server/http/router.h"

namespace gnomon {

/// What a sequence is sent as: the first is the choice without an Accept header.
inline constexpr std::array<std::string_view, 3> kSequenceForms{"multipart/mixed", "application/zip", kEventStream};

/// A reply that sends the frames while they are drawn, and at last the report or a problem. `first`: a frame that was
/// waited for.
HttpReply sequenceReply(std::string_view form, const RouteCall& call, std::shared_ptr<FrameSource> frames,
                        std::optional<DoneFrame> first, RendererInfo renderer);

/// The pictures of one frame: a picture as itself, several as multipart/mixed, each with its view.
HttpReply frameReply(const DoneFrame& frame, const RouteCall& call);

} // namespace gnomon
