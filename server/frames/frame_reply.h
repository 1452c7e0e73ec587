#pragma once

#include <string_view>

#include "protocol/base/result.h"
#include "renderer/render.h"
#include "server/http/negotiation.h"
#include "server/http/reply.h"

namespace gnomon {

/// For each pixel of a frame that is compared with rays: what they hit, and its distance to an edge.
inline constexpr std::size_t kReferenceBytes = 96;

/// What a frame's pictures take in memory between drawing and encoding, at most: four channels a pixel and view, one
/// byte each for PNG and four for EXR.
std::size_t frameBytes(const FrameSpec& spec);

/// The entity tag of a frame: of the scene, the spec, the renderer and the form. Strong for pictures, whose bytes are
/// the same every time; weak for the forms with a report, which holds times.
std::string frameEtag(std::string_view sceneId, const FrameSpec& spec, std::string_view fingerprint, FrameForm form);

/// Encodes the frame in the form asked for, adds the stage `encode` to its report, and lists every stage in
/// Server-Timing. `boundary` separates the parts of a multipart reply; it must not occur in a picture by chance.
Result<HttpReply> frameReply(Frame frame, FrameForm form, std::string_view boundary);

/// "queue;dur=0.12, load;dur=3.4": the value of a Server-Timing header.
std::string serverTiming(const std::vector<StageTime>& stages);

} // namespace gnomon
