#include "server/process/serve_config.h"

#include <CLI/CLI.hpp>
#include <cerrno>
#include <system_error>

#include "protocol/base/config_text.h"
#include "protocol/base/nearest_name.h"
#include "protocol/base/text.h"
#include "server/process/serve_flags.h"
#include "server/scenes/whole_file.h"

// CLI11 has a reader of its own (2.1). It gives no line numbers, cuts a quoted text at its '#', passes over keys that
// are set twice, and lets the file win over the environment. What a value means and may be is still for the options to
// say.
namespace gnomon {
namespace {

constexpr std::size_t kMostBytes = 1 << 20;

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

/// What is wrong; empty = the option has the entry's value.
std::string setOption(CLI::Option& option, const ConfigEntry& entry) {
  if (entry.isList && !takesList(option)) return "It takes one value, not a list.";
  if (isFlag(option) && entry.values[0] != "true" && entry.values[0] != "false") return "It is true or false.";
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
  const auto bytes = readWhole(file, kMostBytes);
  if (bytes) return std::string(asText(*bytes));
  const std::string reason = errno != 0
                                 ? std::generic_category().message(errno)
                                 : "it is no regular file, or larger than " + std::to_string(kMostBytes) + " bytes";
  return Problem{ProblemCode::unavailable, file, "The configuration can't be read: " + reason + ".", "", ""};
}

} // namespace

Status applyConfig(CLI::App& command, const std::string& file) {
  const auto text = textOf(file);
  if (!text) return text.problems();
  const auto entries = parseConfig(*text, file);
  if (!entries) return entries.problems();
  CLI::App checked; // options that are not set yet: a value is checked even where a flag comes before it
  ServeOptions values;
  addServeFlags(checked, values);
  const std::vector<std::string> keys = keysOf(command);
  Problems problems;
  for (const ConfigEntry& entry : *entries) {
    const std::string place = file + ":" + std::to_string(entry.line);
    CLI::Option* const known = checked.get_option_no_throw("--" + entry.key);
    if (known == nullptr || !known->get_configurable()) {
      const std::string detail = "There is no key " + asciiExcerpt(entry.key) + suggestion(entry.key, keys);
      problems.push_back({ProblemCode::invalidValue, place, detail, "", ""});
    } else if (const std::string fault = setOption(*known, entry); !fault.empty()) {
      problems.push_back({ProblemCode::invalidValue, place, entry.key + ": " + fault, "", ""});
    } else if (CLI::Option& option = *command.get_option("--" + entry.key); option.count() == 0) {
      setOption(option, entry);
    }
  }
  if (!problems.empty()) return problems;
  if (const std::string conflict = deviceConflict(command); !conflict.empty()) {
    return Problem{ProblemCode::invalidValue, file, conflict, "", ""};
  }
  return Done{};
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
