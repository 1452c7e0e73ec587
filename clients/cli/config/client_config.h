#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/base/config_text.h"
#include "protocol/base/result.h"

namespace CLI {
class App;
class Option;
} // namespace CLI

/// The file in which people keep the flags that they would type every time.
namespace gnomon::cli {

/// Flags and their values, from one part of the file: KEY is the flag without its dashes.
struct ConfigLayer {
  std::string preset; ///< empty = the entries above all sections: defaults
  std::vector<ConfigEntry> entries;
};

struct ClientConfig {
  std::string file;                ///< empty = there is none
  std::vector<ConfigLayer> layers; ///< the defaults, then every preset
};

/// $XDG_CONFIG_HOME/gnomon/config, or ~/.config/gnomon/config where that variable is unset or no absolute path; empty
/// without a home. Either variable may be null.
std::string usualConfigFile(const char* xdgConfigHome, const char* home);

/// A file's defaults, and its [preset.NAME] sections. Problems: FILE:LINE for each line that can't be read, each other
/// section, and each key that is not one of `keys`.
Result<ClientConfig> parseClientConfig(std::string_view text, const std::string& file,
                                       std::span<const std::string> keys);

/// The defaults and then these presets, in this order. Problems: a preset that there is none of.
Result<std::vector<ConfigLayer>> layersOf(const ClientConfig& config, std::span<const std::string> presets);

/// A file name of a configuration: ~/ is the home, and a relative name begins in the configuration's folder.
std::string fileNamedIn(const std::string& configFile, const std::string& name, const char* home);

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
