#pragma once

#include <string>

#include "clients/cli/remote/http_client.h"
#include "clients/cli/terminal/messages.h"
#include "protocol/base/result.h"
#include "protocol/base/scene_bundle.h"
#include "protocol/json/json_codec.h"

namespace gnomon::cli {

/// What POST /v1/scenes takes.
struct UploadBody {
  std::string contentType;
  std::string bytes;
};

/// A model alone is its own bytes; with files it is multipart/form-data: `scene`, then a `file` for each.
UploadBody uploadBody(const SceneBundle& bundle);

/// The id that the server gives to a model without files: the SHA-256 of its bytes in hexadecimal.
std::string modelId(const Bytes& model);

/// What every call about a scene on a server begins with.

/// The text at a key of a JSON object; empty where there is none.
std::string textAt(const Json& json, const char* key);

/// The problems of an RFC 9457 body, or one that names the status when the body is none.
Problems problemsOf(const std::string& server, const HttpReply& reply);

/// The same call again while the server says that it is busy, as patiently as it asks for.
Result<HttpReply> callPatiently(const Remote& remote, const HttpCall& call, ProgressLine& progress);

/// The scene's id on the server, where it is uploaded unless it is there.
Result<std::string> sceneId(const Remote& remote, const SceneBundle& bundle, ProgressLine& progress);

} // namespace gnomon::cli
