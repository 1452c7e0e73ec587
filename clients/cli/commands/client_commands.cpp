#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <string_view>

#include "clients/cli/commands/commands.h"
#include "clients/cli/terminal/messages.h"
#include "protocol/base/text.h"

namespace gnomon::cli {
namespace {

/// Options whose value - is standard input.
constexpr std::array<std::string_view, 5> kReaders{"scene", "scenes", "--spec", "request", "--key-file"};

void refuseSharedInput(const CLI::App& command) {
  std::ptrdiff_t readers = 0;
  for (const CLI::Option* option : command.get_options()) {
    if (std::find(kReaders.begin(), kReaders.end(), option->get_name()) == kReaders.end()) continue;
    const auto& results = option->results();
    readers += std::count(results.begin(), results.end(), "-");
  }
  if (readers > 1) throw CLI::ValidationError("-", "standard input can be read only once");
}

/// Of an option the value that it was given, on the command line or by a configuration; empty where there is none.
std::string givenTo(const CLI::App& command, const char* flag) {
  const CLI::Option* option = command.get_option_no_throw(flag);
  return option != nullptr && option->count() > 0 ? option->results().back() : std::string();
}

/// The processor has neither a context of OpenGL nor a GPU.
void refuseOpenGlBesideCpu(const CLI::App& command) {
  if (givenTo(command, "--device") != "cpu") return;
  const std::string rest = ", and --device cpu uses none: leave one of the two out";
  const std::string backend = givenTo(command, "--backend");
  const CLI::Option* requireGpu = command.get_option_no_throw("--require-gpu");
  if (requireGpu != nullptr && requireGpu->count() > 0 && requireGpu->as<bool>())
    throw CLI::ValidationError("--require-gpu", "asks for a GPU" + rest);
  if (!backend.empty() && backend != "auto") {
    throw CLI::ValidationError("--backend", "chooses OpenGL's context" + rest);
  }
}

/// Flags of every command: how it talks.
void addMannerFlags(CLI::App& command) {
  command
      .add_option_function<std::string>(
          "--problems",
          [](const std::string& form) { setProblemForm(form == "json" ? ProblemForm::json : ProblemForm::lines); },
          "Form of problems on standard error: text, or one line of JSON")
      ->check(CLI::IsMember({"lines", "json"}))
      ->type_name("")
      ->default_str("lines")
      ->group("Messages");
  if (command.get_option_no_throw("--server") == nullptr) return; // shows no progress
  command.add_flag_callback("--quiet", showNoProgress, "Show no progress")->group("Messages");
}

/// The first word of a command line that names no command; empty where there is none.
std::string unknownCommand(const CLI::App& app) {
  if (!app.get_subcommands().empty()) return {};
  const auto words = app.remaining();
  const auto word = std::find_if(words.begin(), words.end(), [](const auto& each) { return !each.starts_with('-'); });
  return word == words.end() ? std::string() : *word;
}

/// CLI11 itself says only that a command is missing.
std::string failureText(const CLI::App* app, const CLI::Error& error) {
  const std::string word = unknownCommand(*app);
  if (word.empty()) return CLI::FailureMessage::simple(app, error);
  std::vector<std::string> names;
  for (const CLI::App* command :
       app->get_subcommands([](const CLI::App* each) { return !each->get_group().empty(); })) {
    names.push_back(command->get_name());
  }
  return CLI::FailureMessage::simple(
      app, CLI::ValidationError("There is no command " + asciiExcerpt(word) + suggestion(word, names)));
}

} // namespace

std::vector<Subcommand> addClientCommands(CLI::App& app) {
  app.failure_message(failureText);
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
    command->final_callback([command] {
      refuseSharedInput(*command);
      refuseOpenGlBesideCpu(*command);
    });
  }
  return commands;
}

} // namespace gnomon::cli
