#pragma once

#include <string>

#include "clients/cli/remote/http_client.h"
#include "clients/cli/terminal/progress.h"
#include "protocol/base/result.h"
#include "protocol/json/json_codec.h"
#include "renderer/scene/scene_bundle.h"

/// What every call about a scene on a server begins with.
namespace gnomon::cli {

/// The text at a key of a JSON object; empty where there is none.
std::string textAt(const Json& json, const char* key);

/// The problems of an RFC 9457 body, or one that names the status when the body is none.
Problems problemsOf(const std::string& server, const HttpReply& reply);

/// The same call again while the server says that it is busy, as patiently as it asks for.
Result<HttpReply> callPatiently(const std::string& server, const HttpCall& call, Progress& progress);

/// The scene's id on the server, where it is uploaded unless it is there.
Result<std::string> sceneId(const std::string& server, const SceneBundle& bundle, Progress& progress);

} // namespace gnomon::cli
