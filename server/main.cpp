#include <CLI/CLI.hpp>
#include <array>

#include "clients/cli/commands.h"
#include "server/serve_command.h"

int main(int argc, char** argv) {
  using namespace gnomon;
  CLI::App app("Gnomon renders glTF scenes with shadows, without a display.", "gnomon");
  app.set_version_flag("--version", "gnomon " GNOMON_VERSION);
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 done, 1 a problem (told on standard error), 2 the command line is wrong.\n"
      "gnomon COMMAND --help says what a command takes.");
  const std::array commands{addServeCommand(app), cli::addRenderCommand(app), cli::addInspectCommand(app),
                            cli::addHealthCommand(app)};
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
