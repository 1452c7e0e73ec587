#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

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

/// How long to wait before a call is made again: what a 429, or a 503 that names a time, asks for; a second where a
/// server that was there gives no reply, since it may be starting again. Nothing = the reply is final.
std::optional<std::chrono::seconds> pauseAfter(const Result<HttpReply>& reply, bool serverWasThere);

/// The same call again while the server is busy or starts again, for no longer than the patience of `remote`.
Result<HttpReply> callPatiently(const Remote& remote, const HttpCall& call, ProgressLine& progress);

/// The scene's id on the server, where it is uploaded unless it is there.
Result<std::string> sceneId(const Remote& remote, const SceneBundle& bundle, ProgressLine& progress);

/// JSON to be posted about a scene.
struct ScenePost {
  std::string route;      ///< what follows /v1/scenes/ID
  std::string_view body;  ///< must live as long as the call
  std::string_view stage; ///< shown meanwhile
  std::pair<std::string, std::string> header{"Accept", "application/json"};
  std::function<void(std::string_view)> onReceived{}; ///< as in HttpCall
  std::function<void()> onRestart{};
};

/// A call about a scene. `id` may be empty, or known from an earlier call; it is kept for the next. A server that has
/// dropped the scene meanwhile is given it again, unless the bundle has no model: of such a scene nothing but its id is
/// known here.
Result<HttpReply> callAbout(const Remote& remote, const SceneBundle& bundle, std::string& id, const ScenePost& post,
                            ProgressLine& progress);

/// The body of a 200; else the server's problems.
Result<std::string> askAbout(const Remote& remote, const SceneBundle& bundle, std::string& id, const ScenePost& post,
                             ProgressLine& progress);

/// Asks for events, passes each but the last to `onEvent`, and returns the last one's data. `what` is awaited: "bake".
Result<std::string> askWithEvents(const Remote& remote, const SceneBundle& bundle, std::string& id, ScenePost post,
                                  const std::string& what, const std::function<void(const ServerEvent&)>& onEvent,
                                  ProgressLine& progress);

/// Shows an event `progress`: how many are done of how many, and the share of the next.
void showProgress(const ServerEvent& event, ProgressLine& progress);

} // namespace gnomon::cli
