#include "clients/cli/render/evaluation_there.h"

#include <nlohmann/json.hpp>
#include <optional>

#include "clients/cli/remote/event_reader.h"
#include "clients/cli/remote/remote_scene.h"
#include "clients/cli/render/evaluation_here.h"
#include "protocol/evaluation/evaluation_json.h"

namespace gnomon::cli {
namespace {

void showStep(const std::string& data, Progress& progress) {
  const Json json = Json::parse(data, nullptr, false);
  if (!json.is_object() || !json.contains("done") || !json.contains("of")) return;
  const Json &done = json["done"], &of = json["of"];
  if (done.is_number() && of.is_number()) progress.share(of > 0 ? done.get<double>() / of.get<double>() : 0);
}

} // namespace

Result<EvaluationReport> evaluateThere(const std::string& server, const SceneBundle& bundle,
                                       const std::string& requestJson, Progress& progress) {
  const auto id = sceneId(server, bundle, progress);
  if (!id) return id.problems();
  progress.stage("measuring on the server");
  EventReader reader;
  std::optional<ServerEvent> last;
  HttpCall call;
  call.method = "POST";
  call.path = "/v1/scenes/" + *id + "/evaluations";
  call.headers = {{"Accept", "text/event-stream"}};
  call.contentType = "application/json";
  call.body = requestJson;
  call.onReceived = [&](std::string_view bytes) {
    for (ServerEvent& event : reader.read(bytes)) {
      if (event.name == "progress") showStep(event.data, progress);
      if (event.name == "result" || event.name == "problem") last = std::move(event);
    }
  };
  const auto reply = callPatiently(server, call, progress);
  if (!reply) return reply.problems();
  if (reply->status != 200) return problemsOf(server, *reply);
  if (!last) return Problem{ProblemCode::unavailable, server, "The reply ended before the evaluation did.", "", ""};
  if (last->name == "problem") return problemsOf(server, {reply->status, "", last->data, 0});
  auto report = readEvaluationReport(last->data);
  if (!report) return Problem{ProblemCode::internal, server, "The reply is not an evaluation.", "", ""};
  return *std::move(report);
}

} // namespace gnomon::cli
