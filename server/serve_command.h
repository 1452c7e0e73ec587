#pragma once

#include "clients/cli/commands.h"

namespace gnomon {

/// `gnomon serve`: every member of ServeOptions as a flag and as an environment variable.
cli::Subcommand addServeCommand(CLI::App& app);

} // namespace gnomon
