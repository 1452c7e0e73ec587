#pragma once

#include <optional>
#include <string>

#include "clients/cli/remote/http_client.h"
#include "clients/cli/terminal/messages.h"
#include "protocol/base/result.h"
#include "protocol/spec/frame_spec.h"
#include "renderer/render.h"

namespace gnomon::cli {

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
