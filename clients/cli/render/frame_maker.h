#pragma once

#include <optional>
#include <string>
#include <variant>

#include "clients/cli/render/rendering.h"
#include "clients/cli/render/sequence_run.h"

namespace gnomon::cli {

/// Makes frames of one scene after another: in this process by one renderer, or on a server.
class FrameMaker {
 public:
  explicit FrameMaker(BackendOptions here) : where_(std::move(here)) {}
  explicit FrameMaker(Remote there) : where_(std::move(there)) {}

  /// The scene of the frames that follow. In this process it is loaded here; a server is asked with the first frame.
  Status open(SceneBundle bundle, ProgressLine& progress);

  /// The same for a scene that the server has, by its id. REQUIRES: a server.
  void openStored(std::string id);

  bool isOnServer() const { return std::holds_alternative<Remote>(where_); }

  /// REQUIRES: that a scene is open.
  Result<Rendered> draw(const FrameSpec& spec, ProgressLine& progress);

  /// The errors of a frame's shadows and its speed; `requestJson`: an EvaluationRequest.
  /// REQUIRES: that a scene is open.
  Result<EvaluationReport> measure(const std::string& requestJson, ProgressLine& progress);

  /// Every frame of a sequence; `requestJson` is the request that it was decoded from. Gives its report as JSON.
  /// REQUIRES: that a scene is open.
  Result<std::string> drawAll(const Sequence& sequence, const std::string& requestJson, const TakeFrame& take,
                              ProgressLine& progress);

  /// The same as a WebM, which is given piece by piece.
  Result<std::string> drawVideo(const Sequence& sequence, const std::string& requestJson, const TakeBytes& take,
                                ProgressLine& progress);

 private:
  Status load(const SceneBundle& bundle, ProgressLine& progress);

  std::variant<BackendOptions, Remote> where_;
  // In this process
  std::optional<Renderer> renderer_; ///< made with the first scene
  ScenePtr scene_;
  std::optional<double> loadMilliseconds_; ///< until a frame's report has included it
  // On a server
  SceneBundle bundle_; ///< without a model where only the id is known
  std::string id_;     ///< empty = not asked yet
};

} // namespace gnomon::cli
