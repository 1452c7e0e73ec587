#include "clients/cli/render/baking.h"

#include <nlohmann/json.hpp>

#include "clients/cli/remote/http_client.h"
#include "clients/cli/remote/remote_scene.h"
#include "clients/cli/render/local_scene.h"
#include "protocol/bake/bake_json.h"

namespace gnomon::cli {
namespace {

/// Of all lights: those that are done, and the one that is baked.
double shareOfAll(int done, int of, double share) {
  return of > 0 ? (done + share) / of : 0;
}

std::string reportText(const BakeReport& report) {
  return toJson(report).dump(2) + "\n";
}

void showBakeStep(const std::string& data, ProgressLine& progress) {
  const Json json = Json::parse(data, nullptr, false);
  const auto number = [&](const char* key) {
    return json.is_object() && json.contains(key) && json[key].is_number() ? json[key].get<double>() : 0;
  };
  progress.share(shareOfAll(static_cast<int>(number("done")), static_cast<int>(number("of")), number("share")));
}

/// The report of a bake on a server, which tells its progress; `id` as callAbout takes it.
Result<BakeReport> askForBake(const Remote& remote, const SceneBundle& bundle, std::string& id, const FrameSpec& spec,
                              ProgressLine& progress) {
  const std::string body = toJson(spec).dump();
  EventReader reader;
  std::optional<ServerEvent> last;
  const auto callOf = [&](const std::string& scene) {
    HttpCall call;
    call.method = "POST";
    call.path = "/v1/scenes/" + scene + "/bakes";
    call.headers = {{"Accept", "text/event-stream"}};
    call.contentType = "application/json";
    call.body = body;
    call.onReceived = [&](std::string_view bytes) {
      for (ServerEvent& event : reader.read(bytes)) {
        if (event.name == "progress") showBakeStep(event.data, progress);
        if (event.name == "result" || event.name == "problem") last = std::move(event);
      }
    };
    call.onRestart = [&] { reader = {}; };
    return call;
  };
  const auto reply = callAbout(remote, bundle, id, callOf, "baking on the server", progress);
  if (!reply) return reply.problems();
  if (reply->status != 200) return problemsOf(remote.url, *reply);
  if (!last) return Problem{ProblemCode::unavailable, remote.url, "The reply ended before the bake did.", "", ""};
  if (last->name == "problem") return problemsOf(remote.url, {reply->status, "", last->data, 0});
  auto report = readBakeReport(last->data);
  if (!report) return Problem{ProblemCode::internal, remote.url, "The reply is not a bake.", "", ""};
  return *std::move(report);
}

} // namespace

Result<Baked> bakeHere(const SceneBundle& bundle, const BakeOrder& order, const BackendOptions& backend,
                       ProgressLine& progress) {
  const auto here = openHere(bundle, backend, progress);
  if (!here) return here.problems();
  const Baker baker = here->renderer.baker();
  progress.stage("baking");
  const auto report = baker.bake(here->scene, order.spec, [&](const BakeStep& step) {
    progress.share(shareOfAll(step.done, step.of, step.share));
    return true;
  });
  if (!report) return report.problems();
  progress.stage("making the file");
  auto file = baker.file(here->scene, order.spec, order.kind, order.light);
  if (!file) return file.problems();
  return Baked{*std::move(file), reportText(*report)};
}

Result<Baked> bakeThere(const Remote& remote, const SceneBundle& bundle, const BakeOrder& order,
                        ProgressLine& progress) {
  std::string id;
  const auto report = askForBake(remote, bundle, id, order.spec, progress);
  if (!report) return report.problems();
  progress.stage("fetching the file");
  HttpCall fetch;
  fetch.path =
      "/v1/scenes/" + id + "/bakes/" + report->key + (order.light ? "?light=" + std::to_string(*order.light) : "");
  fetch.headers = {{"Accept", std::string(kBakeFileTypes[static_cast<std::size_t>(order.kind)])}};
  const auto reply = callPatiently(remote, fetch, progress);
  if (!reply) return reply.problems();
  if (reply->status != 200) return problemsOf(remote.url, *reply);
  const auto file = asBytes(reply->body);
  return Baked{Bytes(file.begin(), file.end()), reportText(*report)};
}

} // namespace gnomon::cli
