#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <sys/prctl.h>
#include <utility>
#include <vector>

#include "clients/cli/commands/commands.h"
#include "clients/web/web_files.h"
#include "server/process/environment_check.h"
#include "server/process/resource_plan.h"
#include "server/process/serve.h"
#include "server/process/serve_flags.h"
#include "server/process/serve_inputs.h"
#include "server/system/file_descriptor.h"
#include "server/system/memory_limit.h"
#include "server/worker/sandbox.h"
#include "server/worker/worker.h"

namespace gnomon {
namespace {

/// Variables that some command reads, or the process itself.
std::vector<std::string> knownVariables(const CLI::App& app) {
  std::vector<std::string> known{"GNOMON_CPU_TARGET", "GNOMON_KEY"};
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    for (const CLI::Option* option : command->get_options()) {
      if (!option->get_envname().empty()) known.push_back(option->get_envname());
    }
  }
  return known;
}

/// Adds faults of options, each with its line where the file has set one of them. What follows from a value that is
/// wrong by itself is passed over.
void addFaults(const std::vector<OptionFault>& found, const AppliedConfig& applied, std::vector<std::string>& faults) {
  const auto isWrong = [&](std::string_view name) {
    const auto isOwn = [&](const OptionFault& each) { return each.options.size() == 1 && each.options[0] == name; };
    return std::any_of(found.begin(), found.end(), isOwn);
  };
  for (const OptionFault& fault : found) {
    const auto& names = fault.options;
    if (std::any_of(names.begin(), names.end(), [&](auto name) { return applied.faulty.contains(name); })) continue;
    if (names.size() > 1 && std::any_of(names.begin(), names.end(), isWrong)) continue;
    const auto inFile =
        std::find_if(names.begin(), names.end(), [&](auto name) { return applied.places.contains(name); });
    faults.push_back((inFile == names.end() ? "" : applied.places.find(*inFile)->second + ": ") + fault.detail);
  }
}

/// Serves with the options of the command line, the environment and the file that they name.
int serveAsAsked(const CLI::App& app, CLI::App& command, const ConfigChoice& config, const ServeOptions& options) {
  std::vector<std::string> faults = unknownVariables(ownEnvironment(), knownVariables(app));
  const AppliedConfig applied = config.file.empty() ? AppliedConfig() : applyConfig(command, config.file);
  faults.insert(faults.end(), applied.faults.begin(), applied.faults.end());
  std::vector<OptionFault> found = conflictsOf(options);
  ServeInputs inputs = readAddresses(options, found);
  addFaults(found, applied, faults);
  std::vector<OptionFault> inFiles;
  if (!config.print) readFiles(options, inputs, inFiles);
  addFaults(inFiles, applied, faults);
  for (const std::string& fault : faults) std::fprintf(stderr, "gnomon: %s\n", fault.c_str());
  if (!faults.empty()) return cli::kExitUsage;
  if (config.print) {
    std::fputs(configOf(command).c_str(), stdout);
    return std::fflush(stdout) == 0 ? cli::kExitOk : cli::kExitProblem;
  }
  ::prctl(PR_SET_DUMPABLE, 0); // its memory, environment and files are no other process's, one of the same user least
  std::vector<StaticFile> page;
  for (const WebFile& file : webFiles()) page.push_back({file.path, file.contentType, file.bytes});
  return serve(options, std::move(inputs), std::move(page));
}

cli::Subcommand addServeCommand(CLI::App& app) {
  auto options = std::make_shared<ServeOptions>(fittedTo(memoryLimit()));
  auto config = std::make_shared<ConfigChoice>();
  auto* command = app.add_subcommand("serve", "Serve the HTTP API and the web page until SIGTERM or SIGINT");
  addServeFlags(*command, *options);
  addConfigFlags(*command, *config);
  return {[command] { return command->parsed(); },
          [&app, command, options, config] { return serveAsAsked(app, *command, *config, *options); }};
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
      "Exit codes: 0 success, 1 a problem (described on standard error), 2 wrong options, wherever they are from.\n"
      "gnomon COMMAND --help lists the options of a command.");
  std::vector<cli::Subcommand> commands{addServeCommand(app), addWorkerCommand(app)};
  for (cli::Subcommand& command : cli::addClientCommands(app)) commands.push_back(std::move(command));
  if (const auto exit = cli::takeConfiguration(app, {argv + 1, argv + argc})) return *exit;
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
  gnomon::fillStandardDescriptors();
  return gnomon::run(argc, argv);
}
