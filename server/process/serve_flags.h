#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "server/process/serve.h"

namespace CLI {
class App;
}

namespace gnomon {

/// Every choice of ServeOptions as a flag and as an environment variable of the command. `options` must outlive the
/// parsing; its values are the defaults.
void addServeFlags(CLI::App& command, ServeOptions& options);

/// Where the options come from, beside flags and variables.
struct ConfigChoice {
  std::string file;   ///< empty = none
  bool print = false; ///< print all options as such a file, and serve nothing
};
void addConfigFlags(CLI::App& command, ConfigChoice& choice);

/// What a configuration file has done.
struct AppliedConfig {
  std::map<std::string, std::string, std::less<>> places{}; ///< of each option that it has set: "FILE:LINE"
  std::set<std::string, std::less<>> faulty{};              ///< options that it names with a value that they don't take
  std::vector<std::string> faults{};                        ///< all that is wrong with it, as "FILE:LINE: ..."
};

/// Gives each option that neither the command line nor the environment has set its value in a configuration file, which
/// may name any option of the command but --config and --print-config. A wrong line hides no other. REQUIRES: the
/// command line is parsed.
AppliedConfig applyConfig(CLI::App& command, const std::string& file);

/// Every option with its value as it is now, in the form that applyConfig reads.
std::string configOf(const CLI::App& command);

} // namespace gnomon
