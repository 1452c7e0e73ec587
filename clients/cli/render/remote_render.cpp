#include <nlohmann/json.hpp>
#include <optional>

#include "clients/cli/remote/http_client.h"
#include "clients/cli/remote/remote_scene.h"
#include "clients/cli/render/rendering.h"
#include "protocol/base/bytes.h"
#include "protocol/evaluation/evaluation_json.h"
#include "protocol/json/json_codec.h"

namespace gnomon::cli {
namespace {

/// The pictures and the report of an application/json frame; nothing when the reply has another form.
std::optional<Rendered> renderedOf(const std::string& text) {
  const Json body = Json::parse(text, nullptr, false);
  if (!body.is_object() || !body.contains("report") || !body.contains("images")) return std::nullopt;
  Rendered rendered;
  rendered.reportJson = body["report"].dump(2) + "\n";
  for (const Json& image : body["images"]) {
    if (!image.is_object()) return std::nullopt;
    auto file = base64Bytes(textAt(image, "data"));
    if (!file) return std::nullopt;
    rendered.pictures.push_back({textAt(image, "view"), std::move(*file)});
  }
  if (rendered.pictures.empty()) return std::nullopt;
  return rendered;
}

/// What the server says to a spec sent to `route` of the scene; `id` as callAbout takes it.
Result<std::string> askAbout(const Remote& remote, const SceneBundle& bundle, std::string& id, const std::string& route,
                             const FrameSpec& spec, ProgressLine& progress) {
  const std::string body = toJson(spec).dump();
  const auto callOf = [&](const std::string& scene) {
    HttpCall call;
    call.method = "POST";
    call.path = "/v1/scenes/" + scene + route;
    call.headers = {{"Accept", "application/json"}};
    call.contentType = "application/json";
    call.body = body;
    return call;
  };
  auto reply = callAbout(remote, bundle, id, callOf, "working on the server", progress);
  if (!reply) return reply.problems();
  if (reply->status != 200) return problemsOf(remote.url, *reply);
  return std::move(reply->body);
}

} // namespace

Result<Rendered> drawThere(const Remote& remote, const SceneBundle& bundle, std::string& id, const FrameSpec& spec,
                           ProgressLine& progress) {
  const auto reply = askAbout(remote, bundle, id, "/frames", spec, progress);
  if (!reply) return reply.problems();
  auto rendered = renderedOf(*reply);
  if (!rendered) return Problem{ProblemCode::internal, remote.url, "The reply is not a frame.", "", ""};
  return std::move(*rendered);
}

Result<std::string> planThere(const Remote& remote, const SceneBundle& bundle, const FrameSpec& spec,
                              ProgressLine& progress) {
  std::string id;
  const auto reply = askAbout(remote, bundle, id, "/plan", spec, progress);
  if (!reply) return reply.problems();
  const Json plan = Json::parse(*reply, nullptr, false);
  if (!plan.is_object()) return Problem{ProblemCode::internal, remote.url, "The reply is not a plan.", "", ""};
  return plan.dump(2) + "\n";
}

namespace {

void showStep(const std::string& data, ProgressLine& progress) {
  const Json json = Json::parse(data, nullptr, false);
  if (!json.is_object() || !json.contains("done") || !json.contains("of")) return;
  const Json &done = json["done"], &of = json["of"];
  if (done.is_number() && of.is_number()) progress.share(of > 0 ? done.get<double>() / of.get<double>() : 0);
}

} // namespace

Result<EvaluationReport> evaluateThere(const Remote& remote, const SceneBundle& bundle, std::string& id,
                                       const std::string& requestJson, ProgressLine& progress) {
  EventReader reader;
  std::optional<ServerEvent> last;
  const auto callOf = [&](const std::string& scene) {
    HttpCall call;
    call.method = "POST";
    call.path = "/v1/scenes/" + scene + "/evaluations";
    call.headers = {{"Accept", "text/event-stream"}};
    call.contentType = "application/json";
    call.body = requestJson;
    call.onReceived = [&](std::string_view bytes) {
      for (ServerEvent& event : reader.read(bytes)) {
        if (event.name == "progress") showStep(event.data, progress);
        if (event.name == "result" || event.name == "problem") last = std::move(event);
      }
    };
    call.onRestart = [&] { reader = {}; };
    return call;
  };
  const auto reply = callAbout(remote, bundle, id, callOf, "measuring on the server", progress);
  if (!reply) return reply.problems();
  if (reply->status != 200) return problemsOf(remote.url, *reply);
  if (!last) return Problem{ProblemCode::unavailable, remote.url, "The reply ended before the evaluation did.", "", ""};
  if (last->name == "problem") return problemsOf(remote.url, {reply->status, "", last->data, 0});
  auto report = readEvaluationReport(last->data);
  if (!report) return Problem{ProblemCode::internal, remote.url, "The reply is not an evaluation.", "", ""};
  return *std::move(report);
}

} // namespace gnomon::cli
