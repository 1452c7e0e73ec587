#include "server/process/serve_flags.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <map>
#include <regex>
#include <string>

#include "server/process/serve_option_rows.h"
#include "server/wire/message_rows.h"

namespace gnomon {
namespace {

const std::map<std::string, std::int64_t> kTimeUnits{{"s", 1}, {"m", 60}, {"h", 3'600}, {"d", 86'400}};

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
  const auto& [value, range] = row.value;
  if (!value.empty()) option.type_name(std::string(value));
  if (value == kBytes) option.transform(CLI::AsSizeValue(false).description(""));
  if (value == kSeconds) option.transform(CLI::AsNumberWithUnit(kTimeUnits).description(""));
  if (std::isfinite(range.max)) {
    option.check(CLI::Range(static_cast<std::int64_t>(range.min), static_cast<std::int64_t>(range.max)));
  }
}

/// Of an option the value that it was given, wherever; empty where it has none.
std::string givenTo(const CLI::App& command, const char* flag) {
  const CLI::Option& option = *command.get_option(flag);
  return option.count() > 0 ? option.reduced_results().back() : std::string();
}

} // namespace

std::string deviceConflict(const CLI::App& command) {
  if (givenTo(command, "--device") != "cpu") return {};
  const CLI::Option& requireGpu = *command.get_option("--require-gpu");
  if (requireGpu.count() > 0 && requireGpu.as<bool>())
    return "--require-gpu asks for a GPU, and --device cpu uses none: leave one of the two out.";
  const std::string backend = givenTo(command, "--backend");
  if (backend.empty() || backend == "auto") return {};
  return "--backend chooses OpenGL's context, and --device cpu uses none: leave one of the two out.";
}

void addServeFlags(CLI::App& command, ServeOptions& options) {
  command.option_defaults()->always_capture_default();
  for (const OptionGroup& group : kOptionGroups) {
    for (const OptionRow& row : group.rows) addOption(command, group.name, row, options);
  }
  command.get_option("--admin-bind")->needs(command.get_option("--admin-port"));
  command.parse_complete_callback([&command] {
    if (const std::string conflict = deviceConflict(command); !conflict.empty()) throw CLI::ValidationError(conflict);
  });
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

} // namespace gnomon
