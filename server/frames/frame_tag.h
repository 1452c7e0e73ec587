#pragma once

#include <string>
#include <string_view>

#include "protocol/spec/frame_spec.h"
#include "server/http/negotiation.h"

namespace gnomon {

/// The entity tag of a frame: of the scene, the spec, the renderer and the form. Strong where its bytes are the same
/// every time; weak where it tellsTimes.
std::string frameEtag(std::string_view sceneId, const FrameSpec& spec, std::string_view fingerprint, FrameForm form);

/// The value of Repr-Digest (RFC 9530) for a body: sha-256=:BASE64:
std::string reprDigest(std::string_view body);

} // namespace gnomon
