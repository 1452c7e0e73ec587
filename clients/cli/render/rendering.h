#pragma once

#include <optional>
#include <string>
#include <vector>

#include "clients/cli/remote/http_client.h"
#include "clients/cli/terminal/messages.h"
#include "protocol/base/bytes.h"
#include "protocol/base/result.h"
#include "protocol/base/scene_bundle.h"
#include "protocol/evaluation/evaluation.h"
#include "protocol/report/replies.h"
#include "protocol/spec/frame_spec.h"
#include "renderer/render.h"

namespace gnomon::cli {

/// An encoded picture.
struct Picture {
  std::string view; ///< its name; of a file that holds every view, the first one's
  Bytes file;       ///< in the spec's format
};

/// What a frame gives, wherever it was rendered: the same spec gives the same pictures here and there.
struct Rendered {
  std::vector<Picture> pictures; ///< one per view, or one for all, as the format has it
  std::string reportJson;
};

/// Renders in this process. The report gets the stage `encode` besides the renderer's own, and `load` where the scene
/// was loaded for this frame.
Result<Rendered> drawHere(Renderer& renderer, const ScenePtr& scene, const FrameSpec& spec,
                          std::optional<double> loadMilliseconds, ProgressLine& progress);

/// Renders on the server; `id` as callAbout takes it. What the server refuses comes back as its own problems.
Result<Rendered> drawThere(const Remote& remote, const SceneBundle& bundle, std::string& id, const FrameSpec& spec,
                           ProgressLine& progress);

/// Measures in this process, with a renderer and a scene that are there, or with those of its own.
Result<EvaluationReport> evaluateHere(Renderer& renderer, const ScenePtr& scene, const Evaluation& evaluation,
                                      ProgressLine& progress);
Result<EvaluationReport> evaluateHere(const SceneBundle& bundle, const Evaluation& evaluation,
                                      const BackendOptions& backend, ProgressLine& progress);

/// Plans in this process, as JSON. The renderer is created only to ask what it can do; it draws nothing.
Result<std::string> planHere(const SceneBundle& bundle, const FrameSpec& spec, const BackendOptions& backend,
                             ProgressLine& progress);

/// Plans on the server: its JSON.
Result<std::string> planThere(const Remote& remote, const SceneBundle& bundle, const FrameSpec& spec,
                              ProgressLine& progress);

/// Measures on the server, listening to its events; `id` as callAbout takes it; `requestJson`: an EvaluationRequest.
Result<EvaluationReport> evaluateThere(const Remote& remote, const SceneBundle& bundle, std::string& id,
                                       const std::string& requestJson, ProgressLine& progress);

/// A scene, and what draws it, in this process.
struct LocalScene {
  ScenePtr scene;
  Renderer renderer;
  double loadMilliseconds = 0; ///< that the scene took
};

Result<LocalScene> openHere(const SceneBundle& bundle, const BackendOptions& backend, ProgressLine& progress);

/// What to bake, and into which file.
struct BakeOrder {
  FrameSpec spec;
  BakeFile kind = BakeFile::glb;
  std::optional<int> light; ///< as bakeFile takes it
};

/// What a bake gives, wherever it was made.
struct Baked {
  Bytes file;
  std::string reportJson;
};

/// Bakes in this process, with a bar of what is done.
Result<Baked> bakeHere(const SceneBundle& bundle, const BakeOrder& order, const BackendOptions& backend,
                       ProgressLine& progress);

/// Bakes on the server, listening to its events, and fetches the file.
Result<Baked> bakeThere(const Remote& remote, const SceneBundle& bundle, const BakeOrder& order,
                        ProgressLine& progress);

} // namespace gnomon::cli
