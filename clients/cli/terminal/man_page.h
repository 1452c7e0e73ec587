#pragma once

#include <span>
#include <string>

#include "clients/cli/terminal/command_rows.h"

namespace gnomon::cli {

/// gnomon(1) as troff with the man macros. `version`: "gnomon 0.1.0".
std::string manPage(std::span<const CommandRow> commands, const std::string& version);

} // namespace gnomon::cli
