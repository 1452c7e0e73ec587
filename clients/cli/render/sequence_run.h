#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "clients/cli/render/rendering.h"
#include "protocol/sequence/sequence.h"

namespace gnomon::cli {

/// Given the pictures of each frame, in order, while the next one may be drawn; a problem ends the sequence.
using TakeFrame = std::function<Status(int index, const std::vector<Picture>& pictures)>;

/// Given each frame, in order; a problem ends the sequence.
using TakeDrawn = std::function<Status(int index, const Frame& frame)>;

/// Draws a sequence in this process, each frame by `change` of its spec. Gives its report, a SequenceReport as JSON.
Result<std::string> drawSequence(Renderer& renderer, const ScenePtr& scene, const Sequence& sequence,
                                 FrameSpec (*change)(FrameSpec), const TakeDrawn& take, ProgressLine& progress);

/// Shows how far a sequence is once frame `index` is done.
void showFrame(int index, int first, int of, ProgressLine& progress);

/// Draws a sequence in this process. Gives its report, a SequenceReport as JSON.
Result<std::string> sequenceHere(Renderer& renderer, const ScenePtr& scene, const Sequence& sequence,
                                 const TakeFrame& take, ProgressLine& progress);

/// Has a server draw it, listening to its events; `requestJson`: a SequenceRequest; `id` as callAbout takes it.
Result<std::string> sequenceThere(const Remote& remote, const SceneBundle& bundle, std::string& id,
                                  const std::string& requestJson, const TakeFrame& take, ProgressLine& progress);

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
