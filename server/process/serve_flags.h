#pragma once

#include <string>

#include "protocol/base/result.h"
#include "server/process/serve.h"

namespace CLI {
class App;
}

namespace gnomon {

/// Every choice of ServeOptions as a flag and as an environment variable of the command. `options` must outlive the
/// parsing; its values are the defaults.
void addServeFlags(CLI::App& command, ServeOptions& options);

/// What is wrong with the device that the command's options ask for, wherever they are from; empty = nothing. The
/// options of a command line are held against it when they are parsed.
std::string deviceConflict(const CLI::App& command);

/// Where the options come from, beside flags and variables.
struct ConfigChoice {
  std::string file;   ///< empty = none
  bool print = false; ///< print all options as such a file, and serve nothing
};
void addConfigFlags(CLI::App& command, ConfigChoice& choice);

/// Gives each option that neither the command line nor the environment has set its value in a configuration file, which
/// may name any option of the command but --config and --print-config. REQUIRES: the command line is parsed. Problems
/// have the file and the line as their pointer.
Status applyConfig(CLI::App& command, const std::string& file);

/// Every option with its value as it is now, in the form that applyConfig reads.
std::string configOf(const CLI::App& command);

} // namespace gnomon
