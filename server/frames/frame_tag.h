#pragma once

#include <string>
#include <string_view>

#include "protocol/spec/frame_spec.h"
#include "server/http/negotiation.h"

namespace gnomon {

/// The entity tag of a frame: of the scene, the spec, the renderer and the form. Strong for pictures, whose bytes are
/// the same every time; weak for the forms with a report, which holds times.
std::string frameEtag(std::string_view sceneId, const FrameSpec& spec, std::string_view fingerprint, FrameForm form);

} // namespace gnomon
