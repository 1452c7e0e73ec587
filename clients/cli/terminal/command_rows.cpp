#include "clients/cli/terminal/command_rows.h"

#include <CLI/CLI.hpp>

#include "protocol/base/text.h"
#include "protocol/spec/enum_rows.h"

namespace gnomon::cli {
namespace {

/// "TEXT:{auto,cpu,gl}" -> {"auto", "cpu", "gl"}.
std::vector<std::string> choicesIn(const std::string& typeName) {
  const auto begin = typeName.find(":{"), end = typeName.find('}', begin);
  if (begin == std::string::npos || end == std::string::npos) return {};
  return splitTrimmed(typeName.substr(begin + 2, end - begin - 2), ',');
}

template <class Enum>
std::vector<std::string> namesOf() {
  std::vector<std::string> names;
  for (const auto& spelling : kSpellings<Enum>) names.emplace_back(spelling.name);
  return names;
}

/// Values that the fields define rather than the flag.
std::vector<std::string> choicesOf(const CLI::Option& option) {
  const std::string name = option.get_single_name();
  if (name == "view") return namesOf<View>();
  if (name == "format") return namesOf<ImageFormat>();
  return choicesIn(option.get_type_name());
}

FlagRow rowOf(const CLI::Option& option) {
  FlagRow row;
  row.isArgument = option.get_positional();
  row.name = row.isArgument ? option.get_single_name() : "--" + option.get_single_name();
  if (!option.get_snames().empty()) row.shortName = "-" + option.get_snames().front();
  row.says = option.get_description();
  row.choices = choicesOf(option);
  if (option.get_items_expected_max() > 0) {
    const std::string typeName = option.get_type_name();
    row.value = typeName.substr(0, typeName.find(':'));
    if (row.value.empty() || row.value == "TEXT") row.value = row.choices.empty() ? "TEXT" : "NAME";
  }
  row.isRepeatable = option.get_items_expected_max() > 1;
  row.defaultText = option.get_default_str();
  row.variable = option.get_envname();
  row.group = option.get_group();
  row.isFile =
      row.isArgument || row.value == "FILE" || row.name == "--output" || row.name == "--spec" || row.name == "--report";
  return row;
}

} // namespace

std::vector<CommandRow> commandRows(const CLI::App& app) {
  std::vector<CommandRow> rows;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App* each) { return !each->get_group().empty(); })) {
    CommandRow row{command->get_name(), command->get_description(), {}};
    for (const CLI::Option* option : command->get_options()) row.flags.push_back(rowOf(*option));
    rows.push_back(std::move(row));
  }
  return rows;
}

} // namespace gnomon::cli
