#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "clients/cli/render/rendering.h"
#include "protocol/sequence/sequence_json.h"

namespace gnomon::cli {

/// Given the file, piece by piece, as it grows; a problem ends the sequence.
using TakeBytes = std::function<Status(std::string_view bytes)>;

/// Draws a sequence as WebM in this process. Gives its report, a SequenceReport as JSON.
Result<std::string> videoHere(Renderer& renderer, const ScenePtr& scene, const Sequence& sequence,
                              const TakeBytes& take, ProgressLine& progress);

/// Has a server do it; `requestJson`: a SequenceRequest; `id` as callAbout takes it.
Result<std::string> videoThere(const Remote& remote, const SceneBundle& bundle, std::string& id,
                               const std::string& requestJson, const Sequence& sequence, const TakeBytes& take,
                               ProgressLine& progress);

} // namespace gnomon::cli
