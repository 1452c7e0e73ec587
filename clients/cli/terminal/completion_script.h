#pragma once

#include <span>
#include <string>

#include "clients/cli/terminal/command_rows.h"

/// Scripts that make a shell complete commands, flags and the values of flags.
namespace gnomon::cli {

std::string bashCompletion(std::span<const CommandRow> commands);
std::string zshCompletion(std::span<const CommandRow> commands);
std::string fishCompletion(std::span<const CommandRow> commands);

} // namespace gnomon::cli
