#include "clients/cli/render/baking.h"

#include <nlohmann/json.hpp>

#include "clients/cli/remote/http_client.h"
#include "clients/cli/remote/remote_scene.h"
#include "clients/cli/render/local_scene.h"
#include "protocol/bake/bake_json.h"

namespace gnomon::cli {
namespace {

std::string reportText(const BakeReport& report) {
  return toJson(report).dump(2) + "\n";
}

/// The report of a bake on a server, with its progress shown; `id` as callAbout takes it.
Result<BakeReport> askForBake(const Remote& remote, const SceneBundle& bundle, std::string& id, const FrameSpec& spec,
                              ProgressLine& progress) {
  const std::string body = toJson(spec).dump();
  const auto show = [&](const ServerEvent& event) { showProgress(event, progress); };
  const auto text = askWithEvents(remote, bundle, id, {"/bakes", body, "baking on the server"}, "bake", show, progress);
  if (!text) return text.problems();
  auto report = readBakeReport(*text);
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
    progress.share(step.of > 0 ? (step.done + step.share) / step.of : 0);
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
