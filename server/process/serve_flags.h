#pragma once

#include <string>

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

} // namespace gnomon
