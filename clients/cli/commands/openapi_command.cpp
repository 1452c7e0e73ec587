#include <CLI/CLI.hpp>
#include <iostream>
#include <nlohmann/json.hpp>

#include "clients/cli/commands/commands.h"
#include "protocol/openapi/openapi.h"

namespace gnomon::cli {

Subcommand addOpenApiCommand(CLI::App& app) {
  auto* command = app.add_subcommand("openapi", "Print the OpenAPI document of the HTTP API, as /openapi.json has it");
  return {[command] { return command->parsed(); },
          [] {
            std::cout << openApi().dump(2) << '\n' << std::flush;
            return std::cout ? kExitOk : kExitProblem;
          }};
}

} // namespace gnomon::cli
