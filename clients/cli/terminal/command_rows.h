#pragma once

#include <span>
#include <string>
#include <vector>

namespace CLI {
class App;
}

/// What the command line takes, as its own definitions say it: for what is made from them.
namespace gnomon::cli {

struct FlagRow {
  std::string name;      ///< with its dashes; of an argument its bare name
  std::string shortName; ///< "-o"; empty = none
  std::string says;
  std::string value;                ///< "WxH"; empty = a switch
  std::vector<std::string> choices; ///< every value there is; empty = others, too
  std::string defaultText;          ///< empty = none
  std::string variable;             ///< of the environment; empty = none
  std::string group;
  bool isArgument = false;
  bool isRepeatable = false; ///< takes several values
  bool isFile = false;       ///< its value is a file's name
};

struct CommandRow {
  std::string name;
  std::string says;
  std::vector<FlagRow> flags; ///< in the order of --help
};

/// Every command that people use, in the order of --help.
std::vector<CommandRow> commandRows(const CLI::App& app);

// Scripts that make a shell complete commands, flags and the values of flags.
std::string bashCompletion(std::span<const CommandRow> commands);
std::string zshCompletion(std::span<const CommandRow> commands);
std::string fishCompletion(std::span<const CommandRow> commands);

/// gnomon(1) as troff with the man macros. `version`: "gnomon 0.1.0".
std::string manPage(std::span<const CommandRow> commands, const std::string& version);

} // namespace gnomon::cli
