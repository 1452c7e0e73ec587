#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "clients/cli/config/client_config.h"
#include "protocol/base/result.h"

namespace CLI {
class App;
class Option;
} // namespace CLI

/// A configuration laid under the flags of a command line.
namespace gnomon::cli {

/// Origin of a flag's value, by the flag's name with its dashes: "preset small, /home/me/.config/gnomon/config:7".
using FlagPlaces = std::map<std::string, std::string>;

/// Whether a configuration may hold the flag: what the picture is, where and how the work is done. What goes in and
/// comes out of one run is on the command line.
bool isConfigurable(const CLI::Option& option);

/// Sets the flags of a command that is not parsed yet to what the layers, the weakest first, say. `typed`: the same
/// command after the command line was parsed; the flags given there win, and those that they exclude are left alone.
/// Flags of other commands are passed over, and so are those whose required flag is missing. Presets go
/// before variables of the environment, and defaults after them; where a request is given, defaults for the picture do
/// not count, so that a request means the same everywhere. An empty value is none, and hides those of weaker layers.
/// Only --set adds up. Problems: FILE:LINE for each value that the flag refuses.
Result<FlagPlaces> setFlags(CLI::App& command, const CLI::App& typed, const std::string& file,
                            std::span<const ConfigLayer> layers);

} // namespace gnomon::cli
