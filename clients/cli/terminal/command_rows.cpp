#include "clients/cli/terminal/command_rows.h"

#include <CLI/CLI.hpp>

#include "protocol/base/text.h"
#include "protocol/spec/enum_rows.h"
#include "protocol/spec/environment_rows.h"

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
  if (name == "tone-mapping") return namesOf<ToneMapping>();
  if (name == "environment-background") return namesOf<EnvironmentBackground>();
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
  row.isFile = row.isArgument || row.value.starts_with("FILE") || row.name == "--output" || row.name == "--spec" ||
               row.name == "--report";
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

namespace {

/// Text as troff takes it: a backslash begins an escape, a bare - is a hyphen, and . or ' at the beginning of a line a
/// request.
std::string troff(const std::string& text) {
  std::string out = text.starts_with('.') || text.starts_with('\'') ? "\\&" : "";
  for (const char c : text) {
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else
      out += c == '\n' ? ' ' : c;
  }
  return out;
}

std::string listed(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

std::string flagText(const FlagRow& flag) {
  std::string text = ".TP\n";
  if (flag.isArgument) {
    text += "\\fI" + troff(flag.name) + "\\fR\n";
  } else {
    if (!flag.shortName.empty()) text += "\\fB" + troff(flag.shortName) + "\\fR, ";
    text += "\\fB" + troff(flag.name) + "\\fR";
    text += flag.value.empty() ? "\n" : " \\fI" + troff(flag.value) + "\\fR\n";
  }
  text += troff(flag.says + ".") + "\n";
  if (!flag.choices.empty() && flag.name != "--view") text += troff("One of " + listed(flag.choices) + ".") + "\n";
  if (!flag.defaultText.empty()) text += troff("Default: " + flag.defaultText + ".") + "\n";
  if (!flag.variable.empty()) text += troff("Variable: " + flag.variable + ".") + "\n";
  return text;
}

} // namespace

std::string manPage(std::span<const CommandRow> commands, const std::string& version) {
  std::string text =
      ".TH GNOMON 1 \"\" \"" + troff(version) +
      "\" \"User Commands\"\n"
      ".SH NAME\n"
      "gnomon \\- render glTF scenes with shadows, without a display\n"
      ".SH SYNOPSIS\n"
      ".B gnomon\n"
      "\\fICOMMAND\\fR [\\fIOPTION\\fR ...] [\\fIARGUMENT\\fR ...]\n"
      ".SH DESCRIPTION\n"
      "A glTF scene, a camera and lights go in; shadowed pictures come out, made in this process or on a\n"
      "server.\n"
      ".SH COMMANDS\n";
  for (const CommandRow& command : commands) {
    text += ".SS gnomon " + troff(command.name) + "\n" + troff(command.says + ".") + "\n";
    for (const FlagRow& flag : command.flags) text += flagText(flag);
  }
  return text +
         ".SH EXIT STATUS\n"
         ".TP\n0\nDone.\n"
         ".TP\n1\nA problem, printed on standard error; of compare, pictures that differ.\n"
         ".TP\n2\nThe command line is wrong.\n"
         ".SH ENVIRONMENT\n"
         ".TP\n.B GNOMON_KEY\nThe key that a server is shown where no \\-\\-key\\-file is given.\n"
         ".TP\n.B GNOMON_URL\nThe server of the commands that need one.\n"
         ".TP\n.B GNOMON_CLIENT_CONFIG\nThe configuration where no \\-\\-config is given.\n"
         ".SH FILES\n"
         ".TP\n.I ~/.config/gnomon/config\nThe configuration of the commands that draw or call a server: defaults of\n"
         "their flags as KEY = VALUE, and named sets of them below [preset.NAME].\n";
}

} // namespace gnomon::cli
