#pragma once

#include <functional>
#include <string>
#include <vector>

#include "clients/cli/render/rendering.h"
#include "protocol/sequence/sequence_json.h"

namespace gnomon::cli {

/// Given the pictures of each frame, in order, while the next one may be drawn; a problem ends the sequence.
using TakeFrame = std::function<Status(int index, const std::vector<Picture>& pictures)>;

/// Draws a sequence in this process. Gives its report, a SequenceReport as JSON.
Result<std::string> sequenceHere(Renderer& renderer, const ScenePtr& scene, const Sequence& sequence,
                                 const TakeFrame& take, ProgressLine& progress);

/// Has a server draw it, listening to its events; `requestJson`: a SequenceRequest; `id` as callAbout takes it.
Result<std::string> sequenceThere(const Remote& remote, const SceneBundle& bundle, std::string& id,
                                  const std::string& requestJson, const TakeFrame& take, ProgressLine& progress);

} // namespace gnomon::cli
