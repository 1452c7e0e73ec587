#include "clients/cli/render/remote_render.h"

#include <nlohmann/json.hpp>

#include "clients/cli/remote/remote_scene.h"
#include "protocol/base/encoding.h"
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
  if (!rendered) return Problem{ProblemCode::internal, server, "The reply is not a frame.", "", ""};
  return std::move(*rendered);
}

Result<std::string> planThere(const std::string& server, const SceneBundle& bundle, const FrameSpec& spec,
                              Progress& progress) {
  const auto reply = askAbout(server, bundle, "/plan", spec, progress);
  if (!reply) return reply.problems();
  const Json plan = Json::parse(*reply, nullptr, false);
  if (!plan.is_object()) return Problem{ProblemCode::internal, server, "The reply is not a plan.", "", ""};
  return plan.dump(2) + "\n";
}

} // namespace gnomon::cli
