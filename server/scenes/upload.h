#pragma once

#include <string>
#include <vector>

#include "protocol/base/result.h"
#include "protocol/base/scene_bundle.h"
#include "protocol/spec/limits.h"
#include "server/http/multipart.h"
#include "server/http/request.h"
#include "server/scenes/scene_memory.h"

/// A bundle as clients send it.
namespace gnomon {

/// The parts of a form: at most the files of a bundle, its model, a spec and `strict`. Views of the request's body.
Result<std::vector<FormPart>> partsOf(const HttpRequest& request, const Limits& limits);

/// The bundle in a form: the part `scene` is the model; a part `file` (or `files`) is a file under its file name, any
/// other part a file under its own name. `strict` of `true` asks for a bundle that is refused where it violates glTF.
/// Parts named in `others` are left to the caller.
Result<SceneBundle> bundleFromParts(const std::vector<FormPart>& parts, const std::vector<std::string>& others);

/// The bundle in an upload's body: a model by itself, or a form; strict also where the query says so. Takes the body.
Result<SceneBundle> bundleFromRequest(HttpRequest& request, const Limits& limits);

/// A bundle as one file in memory, and what identifies it.
struct PackedBundle {
  std::string id;
  BundlePtr file;
  std::uint64_t bytes = 0;
};

/// unavailable where the system refuses the memory.
Result<PackedBundle> packed(const SceneBundle& bundle);

/// tooLarge where the model and its files together exceed limits.maxSceneBytes.
Status checkBundleSize(const SceneBundle& bundle, const Limits& limits);

} // namespace gnomon
