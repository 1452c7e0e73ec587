#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "clients/cli/commands/commands.h"
#include "clients/cli/commands/spec_flags.h"
#include "clients/cli/files/scene_file.h"
#include "clients/cli/remote/http_client.h"
#include "clients/cli/remote/remote_scene.h"
#include "clients/cli/terminal/messages.h"
#include "clients/cli/terminal/result_text.h"
#include "protocol/json/json_codec.h"
#include "protocol/spec/enum_rows.h"
#include "renderer/render.h"

namespace gnomon::cli {
namespace {

struct InspectOptions {
  std::string scene;
  SceneFileOptions reading;
  bool json = false;
};

Result<SceneSummary> inspect(const InspectOptions& options) {
  auto progress = ProgressLine::onTerminal();
  progress.stage("reading " + options.scene);
  const auto bundle = readSceneFile(options.scene, options.reading);
  if (!bundle) return bundle.problems();
  progress.stage("loading the scene");
  const auto scene = loadScene(*bundle);
  if (!scene) return scene.problems();
  return summaryOf(**scene);
}

int runInspect(const InspectOptions& options) {
  const auto summary = inspect(options);
  if (!summary) return printProblems(ofScene(options.scene, summary.problems()));
  if (options.json) {
    std::cout << toJson(*summary).dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
  } else {
    std::cout << summaryText(options.scene, *summary);
  }
  return kExitOk;
}

} // namespace

Subcommand addInspectCommand(CLI::App& app) {
  auto options = std::make_shared<InspectOptions>();
  auto* command =
      app.add_subcommand("inspect", "Print what a scene holds, and what of it is ignored or drawn differently");
  command->add_option("scene", options->scene, "A .glb or .gltf file")->required();
  addSceneFileFlags(*command, options->reading);
  command->add_flag("--json", options->json, "Print JSON, as the server's summary, instead of a tree");
  return {[command] { return command->parsed(); }, [options] { return runInspect(*options); }};
}

namespace {

struct NamedDevice {
  const char* name;
  BackendOptions backend;
};

template <class Enum>
Json wordsOf() {
  Json names = Json::array();
  for (const auto& spelling : kSpellings<Enum>) names.push_back(spelling.name);
  return names;
}

/// What the server's route says, of the device that draws unless another is asked for; and beside it every device of
/// this machine, each with what it is or why it can't be had.
Result<Json> capabilitiesHere() {
  const NamedDevice devices[] = {{"cpu", {DeviceChoice::cpu, Backend::auto_, false}},
                                 {"egl", {DeviceChoice::gl, Backend::egl, false}},
                                 {"osmesa", {DeviceChoice::gl, Backend::osmesa, false}}};
  RendererOptions options;
  const auto usual = Renderer::create(options);
  if (!usual) return usual.problems();
  Json json = toJson(Capabilities{GNOMON_VERSION, usual->info(), kLimits});
  for (const NamedDevice& device : devices) {
    options.backend = device.backend;
    const auto renderer = Renderer::create(options);
    json["devices"][device.name] =
        renderer ? toJson(renderer->info()) : Json{{"problem", renderer.problems().front().detail}};
  }
  json["formats"] = wordsOf<ImageFormat>();
  json["views"] = wordsOf<View>();
  return json;
}

Result<Json> capabilitiesThere(const Remote& remote, ProgressLine& progress) {
  progress.stage("asking the server");
  HttpCall call;
  call.path = "/v1/capabilities";
  const auto reply = callPatiently(remote, call, progress);
  if (!reply) return reply.problems();
  if (reply->status != 200) return problemsOf(remote.url, *reply);
  Json json = Json::parse(reply->body, nullptr, false);
  if (!json.is_object()) {
    return Problem{ProblemCode::internal, remote.url, "The reply is not a server's capabilities."};
  }
  return json;
}

Result<Json> capabilities(const WhereOptions& where) {
  if (where.server.empty()) return capabilitiesHere();
  const auto remote = remoteOf(where);
  if (!remote) return remote.problems();
  auto progress = ProgressLine::onTerminal();
  return capabilitiesThere(*remote, progress);
}

int runCapabilities(const WhereOptions& where) {
  const auto json = capabilities(where);
  if (!json) return printProblems(json.problems());
  std::cout << json->dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
  return kExitOk;
}

} // namespace

Subcommand addCapabilitiesCommand(CLI::App& app) {
  auto where = std::make_shared<WhereOptions>();
  auto* command =
      app.add_subcommand("capabilities",
                         "Print what can draw here or on a server, with every limit, as JSON; here also each device, "
                         "format and view");
  addServerFlags(*command, *where);
  command->get_option("--server")->description("Capabilities of this server instead of this process")->envname("");
  return {[command] { return command->parsed(); }, [where] { return runCapabilities(*where); }};
}

namespace {

struct HealthOptions {
  std::string url = "http://127.0.0.1:8080";
  int timeoutSeconds = 3;
  bool live = false; ///< whether the server lives is enough
};

int runHealth(const HealthOptions& options) {
  HttpCall call;
  call.path = options.live ? "/livez" : "/readyz";
  call.patience = std::chrono::seconds(options.timeoutSeconds);
  Remote remote;
  remote.url = options.url;
  const auto reply = callServer(remote, call);
  if (!reply) return printProblems(reply.problems());
  if (reply->status == 200) {
    std::cout << (options.live ? "alive\n" : "ready\n");
    return kExitOk;
  }
  return printProblems(
      {{ProblemCode::unavailable, options.url, options.live ? "The server is not alive." : "The server is not ready.",
        "200", std::to_string(reply->status)}});
}

} // namespace

Subcommand addHealthCommand(CLI::App& app) {
  auto options = std::make_shared<HealthOptions>();
  auto* command = app.add_subcommand("health", "Check whether a server is ready: exit code 0 if it is, else 1");
  command->add_option("--server,--url", options->url, "The server's address")
      ->type_name("URL")
      ->envname("GNOMON_URL")
      ->capture_default_str()
      ->group("Server");
  command->add_option("--timeout", options->timeoutSeconds, "Seconds to wait for an answer")
      ->check(CLI::Range(1, 600))
      ->capture_default_str();
  command->add_flag("--live", options->live, "Check liveness instead of readiness: what a container is restarted for");
  return {[command] { return command->parsed(); }, [options] { return runHealth(*options); }};
}

} // namespace gnomon::cli
