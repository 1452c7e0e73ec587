#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <string_view>

#include "clients/cli/commands/commands.h"
#include "clients/cli/commands/config_flags.h"
#include "clients/cli/terminal/messages.h"

namespace gnomon::cli {
namespace {

/// Options whose value - is standard input.
constexpr std::array<std::string_view, 6> kReaders{"scene", "scenes", "spec", "--spec", "--key-file", "request"};

void refuseSharedInput(const CLI::App& command) {
  std::ptrdiff_t readers = 0;
  for (const CLI::Option* option : command.get_options()) {
    if (std::find(kReaders.begin(), kReaders.end(), option->get_name()) == kReaders.end()) continue;
    const auto& results = option->results();
    readers += std::count(results.begin(), results.end(), "-");
  }
  if (readers > 1) throw CLI::ValidationError("-", "standard input can be read only once");
}

/// Flags of every command: how it talks.
void addMannerFlags(CLI::App& command) {
  command
      .add_option_function<std::string>(
          "--problems",
          [](const std::string& form) { tellProblemsAs(form == "json" ? ProblemForm::json : ProblemForm::lines); },
          "How problems are told on standard error: for people, or as one line of JSON")
      ->check(CLI::IsMember({"lines", "json"}))
      ->type_name("")
      ->default_str("lines")
      ->group("Messages");
  if (command.get_option_no_throw("--server") == nullptr) return; // shows no progress
  command.add_flag_callback("--quiet", showNoProgress, "Show no progress")->group("Messages");
}

} // namespace

std::vector<Subcommand> addClientCommands(CLI::App& app) {
  std::vector<Subcommand> commands;
  const auto before = app.get_subcommands([](const CLI::App*) { return true; });
  for (const auto add : {addRenderCommand, addSequenceCommand, addTurntableCommand, addJobsCommand, addWatchCommand,
                         addPlanCommand, addBakeCommand, addEvaluateCommand, addInspectCommand, addCompareCommand,
                         addUploadCommand, addLsCommand, addRmCommand, addCapabilitiesCommand, addHealthCommand,
                         addSignCommand, addOpenApiCommand, addCompletionCommand, addManCommand}) {
    commands.push_back(add(app));
  }
  for (CLI::App* command : app.get_subcommands([](CLI::App*) { return true; })) {
    if (std::find(before.begin(), before.end(), command) != before.end()) continue;
    addMannerFlags(*command);
    addConfigFlags(*command);
    command->final_callback([command] { refuseSharedInput(*command); });
  }
  return commands;
}

} // namespace gnomon::cli
