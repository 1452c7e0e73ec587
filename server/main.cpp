#include <CLI/CLI.hpp>
#include <array>
#include <memory>

#include "clients/cli/commands/commands.h"
#include "clients/web/web_files.h"
#include "server/process/memory_plan.h"
#include "server/process/serve.h"
#include "server/process/serve_flags.h"
#include "server/system/memory_limit.h"
#include "server/worker/sandbox.h"
#include "server/worker/worker.h"

namespace gnomon {
namespace {

cli::Subcommand addServeCommand(CLI::App& app) {
  auto options = std::make_shared<ServeOptions>(fittedTo(memoryLimit()));
  for (const WebFile& file : webFiles()) options->page.push_back({file.path, file.contentType, file.bytes});
  auto* command = app.add_subcommand("serve", "Serve the HTTP API and the web page until SIGTERM or SIGINT");
  addServeFlags(*command, *options);
  return {[command] { return command->parsed(); }, [options] { return serve(*options); }};
}

cli::Subcommand addWorkerCommand(CLI::App& app) {
  auto* command = app.add_subcommand("worker", "Load and draw for `gnomon serve`, which starts this by itself");
  command->group(""); // of no use to people
  return {[command] { return command->parsed(); },
          []() -> int {
            closeInherited();
            runWorker(FileDescriptor(kWorkerChannel));
          }};
}

int run(int argc, char** argv) {
  CLI::App app("Gnomon renders glTF scenes with shadows, without a display.", "gnomon");
  app.set_version_flag("--version", "gnomon " GNOMON_VERSION);
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 success, 1 a problem (described on standard error), 2 a wrong command line.\n"
      "gnomon COMMAND --help lists the options of a command.");
  const std::array commands{addServeCommand(app),        addWorkerCommand(app),      cli::addRenderCommand(app),
                            cli::addPlanCommand(app),    cli::addBakeCommand(app),   cli::addEvaluateCommand(app),
                            cli::addInspectCommand(app), cli::addHealthCommand(app), cli::addSignCommand(app)};
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? cli::kExitOk : cli::kExitUsage;
  }
  for (const cli::Subcommand& command : commands) {
    if (command.chosen()) return command.run();
  }
  return cli::kExitUsage;
}

} // namespace
} // namespace gnomon

int main(int argc, char** argv) {
  return gnomon::run(argc, argv);
}
