#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "clients/cli/commands/commands.h"
#include "clients/cli/commands/spec_flags.h"
#include "clients/cli/remote/remote_scene.h"
#include "clients/cli/terminal/messages.h"
#include "protocol/json/json_codec.h"
#include "protocol/spec/enum_rows.h"
#include "renderer/render.h"

namespace gnomon::cli {
namespace {

struct NamedDevice {
  const char* name;
  BackendOptions backend;
};

template <class Enum>
Json namesOf() {
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
  json["formats"] = namesOf<ImageFormat>();
  json["views"] = namesOf<View>();
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
    return Problem{ProblemCode::internal, remote.url, "The reply is not a server's capabilities.", "", ""};
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

} // namespace gnomon::cli
