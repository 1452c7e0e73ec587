#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "clients/cli/commands/commands.h"
#include "clients/cli/terminal/command_rows.h"
#include "protocol/openapi/openapi.h"

namespace gnomon::cli {
namespace {

int print(const std::string& text) {
  std::cout << text << std::flush;
  return std::cout ? kExitOk : kExitProblem;
}

} // namespace

Subcommand addCompletionCommand(CLI::App& app) {
  auto shell = std::make_shared<std::string>();
  auto* command = app.add_subcommand("completion", "Print a script that makes a shell complete gnomon's commands");
  command->add_option("shell", *shell, "The shell")->required()->check(CLI::IsMember({"bash", "fish", "zsh"}));
  return {[command] { return command->parsed(); },
          [&app, shell] {
            const auto rows = commandRows(app);
            return print(*shell == "bash"  ? bashCompletion(rows)
                         : *shell == "zsh" ? zshCompletion(rows)
                                           : fishCompletion(rows));
          }};
}

Subcommand addManCommand(CLI::App& app) {
  auto* command = app.add_subcommand("man", "Print the manual page: gnomon man | man -l -");
  return {[command] { return command->parsed(); }, [&app] { return print(manPage(commandRows(app), app.version())); }};
}

Subcommand addOpenApiCommand(CLI::App& app) {
  auto* command = app.add_subcommand("openapi", "Print the OpenAPI document of the HTTP API, as /openapi.json has it");
  return {[command] { return command->parsed(); }, [] { return print(openApi().dump(2) + "\n"); }};
}

} // namespace gnomon::cli
