#include "clients/cli/remote/remote_scene.h"

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <thread>
#include <utility>

#include "protocol/base/bytes.h"
#include "protocol/json/problem_rows.h"

namespace gnomon::cli {
namespace {

bool occursIn(const SceneBundle& bundle, const std::string& text) {
  const auto holds = [&](const Bytes& bytes) { return asText(bytes).find(text) != std::string_view::npos; };
  return holds(bundle.model) ||
         std::any_of(bundle.files.begin(), bundle.files.end(), [&](const auto& file) { return holds(file.second); });
}

std::string boundaryFor(const SceneBundle& bundle) {
  std::string boundary = "gnomon-part-boundary";
  for (int i = 0; occursIn(bundle, boundary); ++i) boundary = "gnomon-part-boundary-" + std::to_string(i);
  return boundary;
}

/// As browsers write it (WHATWG, multipart/form-data).
std::string quoted(const std::string& name) {
  std::string text = "\"";
  for (const char c : name) {
    if (c == '"')
      text += "%22";
    else
      text += c;
  }
  return text + "\"";
}

void addPart(std::string& body, const std::string& boundary, const std::string& disposition, const Bytes& content) {
  body += "--" + boundary + "\r\nContent-Disposition: form-data; " + disposition + "\r\n\r\n";
  body += asText(content);
  body += "\r\n";
}

} // namespace

UploadBody uploadBody(const SceneBundle& bundle) {
  if (bundle.files.empty()) {
    const bool isGlb = asText(bundle.model).starts_with("glTF");
    return {isGlb ? "model/gltf-binary" : "model/gltf+json", std::string(asText(bundle.model))};
  }
  const std::string boundary = boundaryFor(bundle);
  UploadBody upload{"multipart/form-data; boundary=" + boundary, ""};
  addPart(upload.bytes, boundary, "name=\"scene\"; filename=\"scene\"", bundle.model);
  for (const auto& [name, content] : bundle.files) {
    addPart(upload.bytes, boundary, "name=\"file\"; filename=" + quoted(name), content);
  }
  upload.bytes += "--" + boundary + "--\r\n";
  return upload;
}

std::string modelId(const Bytes& model) {
  Sha256 hash;
  hash.add(model);
  return hash.hex();
}

std::string textAt(const Json& json, const char* key) {
  const auto found = json.find(key);
  return found != json.end() && found->is_string() ? found->get<std::string>() : "";
}

namespace {

ProblemCode codeAt(const Json& entry) {
  const std::string word = textAt(entry, "code");
  for (const Spelling& spelling : kSpellings<ProblemCode>) {
    if (spelling.name == word) return static_cast<ProblemCode>(spelling.value);
  }
  return ProblemCode::invalidValue;
}

} // namespace

Problems problemsOf(const std::string& server, const HttpReply& reply) {
  const Json body = Json::parse(reply.body, nullptr, false);
  Problems problems;
  if (body.is_object() && body.contains("problems") && body["problems"].is_array()) {
    for (const Json& entry : body["problems"]) {
      if (!entry.is_object()) continue;
      problems.push_back({codeAt(entry), textAt(entry, "pointer"), textAt(entry, "detail"), textAt(entry, "limit"),
                          textAt(entry, "actual")});
    }
  }
  if (problems.empty()) {
    const std::string detail = body.is_object() ? textAt(body, "detail") : "";
    problems.push_back({ProblemCode::unavailable, server, detail.empty() ? "The server refused the request." : detail,
                        "", "status " + std::to_string(reply.status)});
  }
  return problems;
}

std::optional<std::chrono::seconds> pauseAfter(const Result<HttpReply>& reply, bool serverWasThere) {
  using std::chrono::seconds;
  if (!reply) {
    const bool isAway = reply.problems().front().code == ProblemCode::unavailable;
    return isAway && serverWasThere ? std::optional(seconds(1)) : std::nullopt;
  }
  if (reply->status == 429) return seconds(std::max(reply->retryAfterSeconds, 1));
  if (reply->status == 503 && reply->retryAfterSeconds > 0) return seconds(reply->retryAfterSeconds);
  return std::nullopt;
}

Result<HttpReply> callPatiently(const Remote& remote, const HttpCall& call, ProgressLine& progress) {
  const auto end = std::chrono::steady_clock::now() + remote.patience;
  bool hasBegun = false;
  HttpCall watched = call;
  if (call.onReceived) {
    watched.onReceived = [&](std::string_view bytes) {
      hasBegun = true;
      call.onReceived(bytes);
    };
  }
  while (true) {
    auto reply = callServer(remote, watched);
    const auto pause = pauseAfter(reply, *remote.wasThere || hasBegun);
    if (!pause || std::chrono::steady_clock::now() + *pause > end) return reply;
    if (hasBegun && !call.onRestart) return reply;
    if (std::exchange(hasBegun, false)) call.onRestart();
    progress.stage(reply ? "waiting: the server is busy" : "waiting for the server");
    std::this_thread::sleep_for(*pause);
  }
}

Result<std::string> sceneId(const Remote& remote, const SceneBundle& bundle, ProgressLine& progress) {
  if (bundle.files.empty() && !bundle.strict) { // one that is there may have been repaired
    progress.stage("asking for the scene");
    const std::string id = modelId(bundle.model);
    HttpCall ask;
    ask.method = "HEAD";
    ask.path = "/v1/scenes/" + id;
    const auto known = callPatiently(remote, ask, progress);
    if (!known) return known.problems();
    if (known->status == 200) return id;
  }
  progress.stage("uploading the scene");
  const UploadBody upload = uploadBody(bundle);
  HttpCall post;
  post.method = "POST";
  post.path = bundle.strict ? "/v1/scenes?strict=true" : "/v1/scenes";
  post.contentType = upload.contentType;
  post.body = upload.bytes;
  post.onSent = [&progress](double share) { progress.share(share); };
  const auto reply = callPatiently(remote, post, progress);
  if (!reply) return reply.problems();
  if (reply->status != 200 && reply->status != 201) return problemsOf(remote.url, *reply);
  const Json summary = Json::parse(reply->body, nullptr, false);
  const std::string id = summary.is_object() ? textAt(summary, "id") : "";
  if (id.empty()) return Problem{ProblemCode::internal, remote.url, "The reply to the upload names no scene."};
  return id;
}

Result<HttpReply> callAbout(const Remote& remote, const SceneBundle& bundle, std::string& id, const ScenePost& post,
                            ProgressLine& progress) {
  constexpr int kMostUploads = 3; // a server that keeps dropping the scene has no room for it
  HttpCall call;
  call.method = "POST";
  call.headers = {post.header};
  call.contentType = "application/json";
  call.body = post.body;
  call.onReceived = post.onReceived;
  call.onRestart = post.onRestart;
  for (int uploads = 1;; ++uploads) {
    if (id.empty()) {
      auto found = sceneId(remote, bundle, progress);
      if (!found) return found.problems();
      id = *std::move(found);
    }
    progress.stage(std::string(post.stage));
    call.path = "/v1/scenes/" + id + post.route;
    auto reply = callPatiently(remote, call, progress);
    if (!reply || reply->status != 404 || bundle.model.empty() || uploads == kMostUploads) return reply;
    id.clear();
  }
}

Result<std::string> askAbout(const Remote& remote, const SceneBundle& bundle, std::string& id, const ScenePost& post,
                             ProgressLine& progress) {
  auto reply = callAbout(remote, bundle, id, post, progress);
  if (!reply) return reply.problems();
  if (reply->status != 200) return problemsOf(remote.url, *reply);
  return std::move(reply->body);
}

Result<std::string> askWithEvents(const Remote& remote, const SceneBundle& bundle, std::string& id, ScenePost post,
                                  const std::string& what, const std::function<void(const ServerEvent&)>& onEvent,
                                  ProgressLine& progress) {
  EventReader reader;
  std::optional<ServerEvent> last;
  post.header.second = "text/event-stream";
  post.onReceived = [&](std::string_view bytes) {
    for (ServerEvent& event : reader.read(bytes)) {
      const bool isLast = event.name == "result" || event.name == "problem";
      if (!isLast) onEvent(event);
      if (isLast) last = std::move(event);
    }
  };
  post.onRestart = [&] { reader = {}; };
  const auto reply = askAbout(remote, bundle, id, post, progress);
  if (!reply) return reply.problems();
  if (!last) {
    return Problem{ProblemCode::unavailable, remote.url, "The reply ended before the " + what + " did."};
  }
  if (last->name == "problem") return problemsOf(remote.url, {200, "", last->data, 0});
  return std::move(last->data);
}

void showProgress(const ServerEvent& event, ProgressLine& progress) {
  const Json json = Json::parse(event.data, nullptr, false);
  const auto number = [&](const char* key) {
    return json.is_object() && json.contains(key) && json[key].is_number() ? json[key].get<double>() : 0;
  };
  const double of = number("of");
  if (event.name == "progress" && of > 0) progress.share((number("done") + number("share")) / of);
}

} // namespace gnomon::cli
