#pragma once

#include "clients/cli/terminal/messages.h"
#include "renderer/render.h"

namespace gnomon::cli {

/// A scene, and what draws it, in this process.
struct LocalScene {
  ScenePtr scene;
  Renderer renderer;
  double loadMilliseconds = 0; ///< that the scene took
};

Result<LocalScene> openHere(const SceneBundle& bundle, const BackendOptions& backend, ProgressLine& progress);

} // namespace gnomon::cli
