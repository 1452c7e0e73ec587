#pragma once

#include <string>

#include "protocol/base/result.h"

namespace CLI {
class App;
}

namespace gnomon {

/// Gives each option that neither the command line nor the environment has set its value in a configuration file, which
/// may name any option of the command but --config and --print-config. REQUIRES: the command line is parsed. Problems
/// have the file and the line as their pointer.
Status applyConfig(CLI::App& command, const std::string& file);

/// Every option with its value as it is now, in the form that applyConfig reads.
std::string configOf(const CLI::App& command);

} // namespace gnomon
