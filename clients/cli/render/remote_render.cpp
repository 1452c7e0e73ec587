#include <nlohmann/json.hpp>
#include <optional>

#include "clients/cli/remote/http_client.h"
#include "clients/cli/remote/remote_scene.h"
#include "clients/cli/render/rendering.h"
#include "protocol/bake/bake.h"
#include "protocol/base/bytes.h"
#include "protocol/evaluation/evaluation.h"
#include "protocol/json/json_codec.h"
#include "protocol/spec/debug_light.h"

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

/// The report of a bake on a server, with its progress shown; `id` as callAbout takes it.
Result<BakeReport> askForBake(const Remote& remote, const SceneBundle& bundle, std::string& id, const FrameSpec& spec,
                              ProgressLine& progress) {
  const std::string body = toJson(spec).dump();
  const auto show = [&](const ServerEvent& event) { showProgress(event, progress); };
  const auto text = askWithEvents(remote, bundle, id, {"/bakes", body, "baking on the server"}, "bake", show, progress);
  if (!text) return text.problems();
  auto report = readBakeReport(*text);
  if (!report) return Problem{ProblemCode::internal, remote.url, "The reply is not a bake."};
  return *std::move(report);
}

} // namespace

Result<Rendered> drawThere(const Remote& remote, const SceneBundle& bundle, std::string& id, const FrameSpec& spec,
                           ProgressLine& progress) {
  const std::string body = toJson(spec).dump();
  const auto reply = askAbout(remote, bundle, id, {"/frames", body, "working on the server"}, progress);
  if (!reply) return reply.problems();
  auto rendered = renderedOf(*reply);
  if (!rendered) return Problem{ProblemCode::internal, remote.url, "The reply is not a frame."};
  return std::move(*rendered);
}

Result<std::string> planThere(const Remote& remote, const SceneBundle& bundle, const FrameSpec& spec,
                              ProgressLine& progress) {
  std::string id;
  const std::string body = toJson(spec).dump();
  const auto reply = askAbout(remote, bundle, id, {"/plan", body, "working on the server"}, progress);
  if (!reply) return reply.problems();
  const Json plan = Json::parse(*reply, nullptr, false);
  if (!plan.is_object()) return Problem{ProblemCode::internal, remote.url, "The reply is not a plan."};
  return plan.dump(2) + "\n";
}

Result<EvaluationReport> evaluateThere(const Remote& remote, const SceneBundle& bundle, std::string& id,
                                       const std::string& requestJson, ProgressLine& progress) {
  const auto show = [&](const ServerEvent& event) { showProgress(event, progress); };
  const auto text = askWithEvents(remote, bundle, id, {"/evaluations", requestJson, "measuring on the server"},
                                  "evaluation", show, progress);
  if (!text) return text.problems();
  auto report = readEvaluationReport(*text);
  if (!report) return Problem{ProblemCode::internal, remote.url, "The reply is not an evaluation."};
  return *std::move(report);
}

Result<Baked> bakeThere(const Remote& remote, const SceneBundle& bundle, const BakeOrder& order,
                        ProgressLine& progress) {
  std::string id;
  const auto report = askForBake(remote, bundle, id, order.spec, progress);
  if (!report) return report.problems();
  progress.stage("fetching the file");
  HttpCall fetch;
  fetch.path = "/v1/scenes/" + id + "/bakes/" + report->key;
  if (order.light) {
    fetch.path +=
        "?light=" + (*order.light == kEnvironmentLight ? std::string(kEnvironmentName) : std::to_string(*order.light));
  }
  fetch.headers = {{"Accept", std::string(kBakeFileTypes[static_cast<std::size_t>(order.kind)])}};
  const auto reply = callPatiently(remote, fetch, progress);
  if (!reply) return reply.problems();
  if (reply->status != 200) return problemsOf(remote.url, *reply);
  const auto file = asBytes(reply->body);
  return Baked{Bytes(file.begin(), file.end()), toJson(*report).dump(2) + "\n"};
}

} // namespace gnomon::cli
