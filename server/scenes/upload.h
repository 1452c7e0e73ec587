#pragma once

#include "protocol/spec/limits.h"
#include "server/http/http_request.h"
#include "server/scenes/multipart.h"

namespace gnomon {

/// The bundle in an upload's body: a model by itself, or a form. Takes the body.
Result<SceneBundle> bundleFromRequest(HttpRequest& request, const Limits& limits);

/// The parts of a form. They look into the request's body.
Result<std::vector<FormPart>> partsOf(const HttpRequest& request, const Limits& limits);

/// tooLarge when the model and its files together pass limits.maxSceneBytes.
Status checkBundleSize(const SceneBundle& bundle, const Limits& limits);

} // namespace gnomon
