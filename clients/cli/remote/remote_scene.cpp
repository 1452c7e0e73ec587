#include "clients/cli/remote/remote_scene.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <thread>

#include "clients/cli/remote/upload_body.h"

namespace gnomon::cli {
namespace {

constexpr int kMostWaits = 20; // for a busy server

} // namespace

std::string textAt(const Json& json, const char* key) {
  const auto found = json.find(key);
  return found != json.end() && found->is_string() ? found->get<std::string>() : "";
}

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
    problems.push_back({ProblemCode::unavailable, server, detail.empty() ? "The server refused the request." : detail,
                        "", "status " + std::to_string(reply.status)});
  }
  return problems;
}

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
  if (id.empty()) return Problem{ProblemCode::internal, server, "The reply to the upload names no scene.", "", ""};
  return id;
}

} // namespace gnomon::cli
