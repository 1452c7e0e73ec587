#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

/// The subcommands of the binary that need no server in the process.
namespace gnomon::cli {

/// Exit codes.
enum ExitCode : int {
  kExitOk = 0,
  kExitProblem = 1, ///< the request, the scene, the server or the disk refused; every problem is on stderr
  kExitUsage = 2    ///< the command line itself is wrong
};

/// A subcommand that was declared: run it once the command line has been parsed and `chosen` is true.
struct Subcommand {
  std::function<bool()> chosen;
  std::function<int()> run; ///< gives an ExitCode
};

/// Sets the flags that the client's configuration says, and that `arguments` (a command line without the program's
/// name) leaves open, before `app` parses them. Tells what is wrong and gives an ExitCode where there is no way on.
std::optional<int> takeConfiguration(CLI::App& app, const std::vector<std::string>& arguments);

/// --preset, --config, --no-config and --show-config, for a command that draws or calls a server.
void addConfigFlags(CLI::App& command);

/// Every command that needs no server in the process. `app` outlives them: some print what it holds.
std::vector<Subcommand> addClientCommands(CLI::App& app);

Subcommand addBakeCommand(CLI::App& app);
Subcommand addCapabilitiesCommand(CLI::App& app);
Subcommand addCompareCommand(CLI::App& app);
Subcommand addCompletionCommand(CLI::App& app);
Subcommand addEvaluateCommand(CLI::App& app);
Subcommand addHealthCommand(CLI::App& app);
Subcommand addInspectCommand(CLI::App& app);
Subcommand addJobsCommand(CLI::App& app);
Subcommand addLsCommand(CLI::App& app);
Subcommand addManCommand(CLI::App& app);
Subcommand addOpenApiCommand(CLI::App& app);
Subcommand addPlanCommand(CLI::App& app);
Subcommand addRenderCommand(CLI::App& app);
Subcommand addRmCommand(CLI::App& app);
Subcommand addSequenceCommand(CLI::App& app);
Subcommand addSignCommand(CLI::App& app);
Subcommand addTurntableCommand(CLI::App& app);
Subcommand addUploadCommand(CLI::App& app);
Subcommand addWatchCommand(CLI::App& app);

} // namespace gnomon::cli
