#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "clients/cli/commands/commands.h"
#include "clients/cli/remote/http_client.h"
#include "clients/cli/terminal/messages.h"

namespace gnomon::cli {
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
