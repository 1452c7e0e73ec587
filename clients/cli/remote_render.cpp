#include "clients/cli/remote_render.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <thread>

#include "clients/cli/base64.h"
#include "clients/cli/http_client.h"
#include "clients/cli/upload_body.h"
#include "protocol/json_codec.h"

namespace gnomon::cli {
namespace {

constexpr int kMostWaits = 20; // for a busy server

std::string textAt(const Json& json, const char* key) {
  const auto found = json.find(key);
  return found != json.end() && found->is_string() ? found->get<std::string>() : "";
}

/// The problems of an RFC 9457 body, or one that names the status when the body is none.
Problems problemsOf(const std::string& server, const HttpReply& reply) {
  const Json body = Json::parse(reply.body, nullptr, false);
  Problems problems;
  if (body.is_object() && body.contains("problems") && body["problems"].is_array()) {
    for (const Json& entry : body["problems"]) {
      if (!entry.is_object()) continue;
      problems.push_back({ProblemCode::invalidValue, textAt(entry, "pointer"), textAt(entry, "detail"),
                          textAt(entry, "limit"), textAt(entry, "actual")});
    }
  }
  if (problems.empty()) {
    const std::string detail = body.is_object() ? textAt(body, "detail") : "";
    problems.push_back({ProblemCode::unavailable, server, detail.empty() ? "the server refused" : detail, "",
                        "status " + std::to_string(reply.status)});
  }
  return problems;
}

/// The same call again while the server says that it is busy, as patiently as it asks for.
Result<HttpReply> callPatiently(const std::string& server, const HttpCall& call, Progress& progress) {
  for (int waits = 0;; ++waits) {
    auto reply = callServer(server, call);
    if (!reply || reply->status != 429 || waits == kMostWaits) return reply;
    progress.stage("waiting: the server is busy");
    std::this_thread::sleep_for(std::chrono::seconds(std::clamp(reply->retryAfterSeconds, 1, 30)));
  }
}

Result<std::string> sceneId(const std::string& server, const SceneBundle& bundle, Progress& progress) {
  if (bundle.files.empty()) {
    progress.stage("asking for the scene");
    const std::string id = modelId(bundle.model);
    HttpCall ask;
    ask.method = "HEAD";
    ask.path = "/v1/scenes/" + id;
    const auto known = callServer(server, ask);
    if (!known) return known.problems();
    if (known->status == 200) return id;
  }
  progress.stage("uploading the scene");
  const UploadBody upload = uploadBody(bundle);
  HttpCall post;
  post.method = "POST";
  post.path = "/v1/scenes";
  post.contentType = upload.contentType;
  post.body = upload.bytes;
  post.onSent = [&progress](double share) { progress.share(share); };
  const auto reply = callPatiently(server, post, progress);
  if (!reply) return reply.problems();
  if (reply->status != 200 && reply->status != 201) return problemsOf(server, *reply);
  const Json summary = Json::parse(reply->body, nullptr, false);
  const std::string id = summary.is_object() ? textAt(summary, "id") : "";
  if (id.empty()) return Problem{ProblemCode::internal, server, "the reply to the upload names no scene", "", ""};
  return id;
}

/// The pictures and the report of an application/json frame; nothing when the reply has another form.
std::optional<Rendered> renderedOf(const std::string& text) {
  const Json body = Json::parse(text, nullptr, false);
  if (!body.is_object() || !body.contains("report") || !body.contains("images")) return std::nullopt;
  Rendered rendered;
  rendered.reportJson = body["report"].dump(2) + "\n";
  for (const Json& image : body["images"]) {
    if (!image.is_object()) return std::nullopt;
    auto file = base64Decoded(textAt(image, "data"));
    if (!file) return std::nullopt;
    rendered.pictures.push_back({textAt(image, "view"), std::move(*file)});
  }
  if (rendered.pictures.empty()) return std::nullopt;
  return rendered;
}

/// What the server says to a spec sent to `route` of the scene, which is uploaded unless it is there.
Result<std::string> askAbout(const std::string& server, const SceneBundle& bundle, const std::string& route,
                             const FrameSpec& spec, Progress& progress) {
  const auto id = sceneId(server, bundle, progress);
  if (!id) return id.problems();

  progress.stage("working on the server");
  const std::string body = toJson(spec).dump();
  HttpCall call;
  call.method = "POST";
  call.path = "/v1/scenes/" + *id + route;
  call.headers = {{"Accept", "application/json"}};
  call.contentType = "application/json";
  call.body = body;
  auto reply = callPatiently(server, call, progress);
  if (!reply) return reply.problems();
  if (reply->status != 200) return problemsOf(server, *reply);
  return std::move(reply->body);
}

} // namespace

Result<Rendered> renderThere(const std::string& server, const SceneBundle& bundle, const FrameSpec& spec,
                             Progress& progress) {
  const auto reply = askAbout(server, bundle, "/frames", spec, progress);
  if (!reply) return reply.problems();
  auto rendered = renderedOf(*reply);
  if (!rendered) return Problem{ProblemCode::internal, server, "the reply is not a frame", "", ""};
  return std::move(*rendered);
}

Result<std::string> planThere(const std::string& server, const SceneBundle& bundle, const FrameSpec& spec,
                              Progress& progress) {
  const auto reply = askAbout(server, bundle, "/plan", spec, progress);
  if (!reply) return reply.problems();
  const Json plan = Json::parse(*reply, nullptr, false);
  if (!plan.is_object()) return Problem{ProblemCode::internal, server, "the reply is not a plan", "", ""};
  return plan.dump(2) + "\n";
}

} // namespace gnomon::cli
