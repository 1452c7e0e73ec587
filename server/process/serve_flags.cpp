#include "server/process/serve_flags.h"

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cmath>
#include <map>
#include <regex>
#include <system_error>

#include "protocol/base/config_text.h"
#include "protocol/base/text.h"
#include "server/process/serve_option_rows.h"
#include "server/scenes/whole_file.h"
#include "server/wire/message_rows.h"

namespace gnomon {
namespace {

/// What --help leaves out of Markdown: backquotes, and of a link everything but its text.
const std::regex kMarkdown(R"(\[([^\]]*)\]\([^)]*\)|`)");

/// GNOMON_STORE_BYTES of "store-bytes". "port" gives GNOMON_LISTEN_PORT: Kubernetes sets GNOMON_PORT to an address
/// where a service is called gnomon.
std::string variableOf(std::string_view name) {
  std::string words(name);
  if (name.ends_with("port")) words.insert(words.rfind("port"), "listen-");
  std::string variable = "GNOMON_";
  for (const char c : words) variable += c == '-' ? '_' : static_cast<char>(c - 'a' + 'A');
  return variable;
}

template <Spelled Enum>
CLI::Option* addWord(CLI::App& command, const std::string& flag, Enum& value, const std::string& says) {
  std::map<std::string, Enum> words;
  for (const Spelling& each : kSpellings<Enum>) words.emplace(each.name, static_cast<Enum>(each.value));
  const auto set = [&value, words](const std::string& word) { value = words.at(word); };
  return command.add_option_function<std::string>(flag, set, says)
      ->check(CLI::IsMember(words))
      ->type_name("")
      ->default_str(std::string(spell(value)));
}

template <class T>
CLI::Option* addValue(CLI::App& command, const std::string& flag, T& value, const std::string& says) {
  if constexpr (std::is_same_v<T, bool>) {
    return command.add_flag(flag, value, says);
  } else if constexpr (Spelled<T>) {
    return addWord(command, flag, value, says);
  } else if constexpr (std::is_same_v<T, std::vector<std::string>>) {
    return command.add_option(flag, value, says)->delimiter(',')->default_str("");
  } else if constexpr (std::is_same_v<T, std::optional<int>>) {
    return command.add_option(flag, value, says)->default_str("");
  } else {
    return command.add_option(flag, value, says);
  }
}

void addOption(CLI::App& command, std::string_view group, const OptionRow& row, ServeOptions& options) {
  const std::string flag = "--" + std::string(row.name);
  const std::string says = std::regex_replace(std::string(row.says), kMarkdown, "$1");
  const auto add = [&](auto member) { return addValue(command, flag, options.*member, says); };
  CLI::Option& option = *std::visit(add, row.member);
  option.envname(variableOf(row.name))->group(std::string(group));
  const OptionValue& value = row.value;
  if (!value.name.empty()) option.type_name(std::string(value.name));
  if (std::isfinite(value.range.max)) {
    const auto toNumber = [&value](std::string& text) { return toPlainNumber(text, value); };
    option.transform(CLI::Validator(toNumber, rangeText(value)));
  }
  if (value.fault != nullptr)
    option.check(CLI::Validator([&value](std::string& text) { return value.fault(text); }, ""));
}

constexpr std::size_t kMostText = 1 << 20; ///< bytes of a configuration file

std::vector<std::string> keysOf(const CLI::App& command) {
  std::vector<std::string> keys;
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_configurable()) keys.push_back(option->get_single_name());
  }
  return keys;
}

bool isFlag(const CLI::Option& option) {
  return option.get_expected_min() == 0;
}

bool takesList(const CLI::Option& option) {
  return option.get_items_expected_max() > 1;
}

/// What is wrong, with the option's name, as with its flag; empty = the option has the entry's value.
std::string setOption(CLI::Option& option, const ConfigEntry& entry) {
  const std::string name = "--" + entry.key;
  if (entry.isList && !takesList(option)) return name + ": It takes one value, not a list.";
  if (isFlag(option) && entry.values[0] != "true" && entry.values[0] != "false") return name + ": It is true or false.";
  const bool isEmpty = entry.values.empty() || (!entry.isList && entry.values[0].empty());
  if (isEmpty && option.get_default_str().empty()) return {};
  try {
    option.add_result(entry.values);
    option.run_callback();
  } catch (const CLI::Error& error) {
    return error.what();
  }
  return {};
}

Result<std::string> textOf(const std::string& file) {
  errno = 0;
  const auto bytes = readWhole(file, kMostText);
  if (bytes) return std::string(asText(*bytes));
  const std::string reason = errno != 0
                                 ? std::generic_category().message(errno)
                                 : "it is no regular file, or larger than " + std::to_string(kMostText) + " bytes";
  return Problem{ProblemCode::unavailable, file, "The configuration can't be read: " + reason + ".", "", ""};
}

} // namespace

void addServeFlags(CLI::App& command, ServeOptions& options) {
  command.option_defaults()->always_capture_default();
  for (const OptionGroup& group : kOptionGroups) {
    for (const OptionRow& row : group.rows) addOption(command, group.name, row, options);
  }
}

void addConfigFlags(CLI::App& command, ConfigChoice& choice) {
  command
      .add_option("--config", choice.file,
                  "File with further options, one KEY = VALUE a line; keys are these flags without their dashes. Flags "
                  "come before variables, variables before the file")
      ->envname("GNOMON_CONFIG")
      ->type_name("FILE")
      ->configurable(false)
      ->group("Configuration");
  command
      .add_flag("--print-config", choice.print,
                "Print all options, wherever their values are from, as such a file, and exit")
      ->configurable(false)
      ->group("Configuration");
}

// CLI11 has a reader of its own (2.1). It gives no line numbers, cuts a quoted text at its '#', passes over keys that
// are set twice, and lets the file win over the environment.
AppliedConfig applyConfig(CLI::App& command, const std::string& file) {
  AppliedConfig applied;
  const auto refuse = [&](const std::string& place, const std::string& detail) {
    applied.faults.push_back(place + ": " + detail);
  };
  const auto text = textOf(file);
  const ConfigEntries read = text ? parseConfig(*text, file) : ConfigEntries{{}, text.problems()};
  for (const Problem& problem : read.problems) refuse(problem.pointer, problem.detail);
  CLI::App checked; // options that are not set yet: a value is checked even where a flag comes before it
  ServeOptions values;
  addServeFlags(checked, values);
  const std::vector<std::string> keys = keysOf(command);
  for (const ConfigEntry& entry : read.entries) {
    const std::string place = file + ":" + std::to_string(entry.line);
    CLI::Option* const known = checked.get_option_no_throw("--" + entry.key);
    if (known == nullptr || !known->get_configurable()) {
      refuse(place, "There is no key " + asciiExcerpt(entry.key) + suggestion(entry.key, keys));
    } else if (const std::string fault = setOption(*known, entry); !fault.empty()) {
      applied.faulty.insert(entry.key);
      refuse(place, fault);
    } else if (CLI::Option& option = *command.get_option("--" + entry.key); option.count() == 0) {
      setOption(option, entry);
      applied.places.emplace(entry.key, place);
    }
  }
  return applied;
}

std::string configOf(const CLI::App& command) {
  std::string text;
  std::string group;
  for (const CLI::Option* option : command.get_options()) {
    if (!option->get_configurable()) continue;
    if (option->get_group() != group) {
      group = option->get_group();
      text += (text.empty() ? "# " : "\n# ") + group + "\n";
    }
    const bool isSet = option->count() > 0;
    std::string value;
    if (isFlag(*option)) {
      value = isSet && option->as<bool>() ? "true" : "false";
    } else if (takesList(*option)) {
      value = configList(isSet ? option->reduced_results() : std::vector<std::string>());
    } else {
      value = configValue(isSet ? option->reduced_results().back() : option->get_default_str());
    }
    text += option->get_single_name() + " = " + value + "\n";
  }
  return text;
}

} // namespace gnomon
