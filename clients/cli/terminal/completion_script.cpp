#include "clients/cli/terminal/command_rows.h"

namespace gnomon::cli {
namespace {

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

std::string flagNames(const CommandRow& command) {
  std::string names;
  for (const FlagRow& flag : command.flags) {
    if (!flag.isArgument) names += (names.empty() ? "" : " ") + flag.name;
    if (!flag.isArgument && !flag.shortName.empty()) names += " " + flag.shortName;
  }
  return names;
}

/// Within '…' of a shell.
std::string escaped(const std::string& text, const char* quote) {
  std::string out;
  for (const char c : text) {
    if (c == '\'')
      out += quote;
    else
      out += c;
  }
  return out;
}

/// The description of zsh's _arguments: brackets and colons are its own.
std::string zshText(const std::string& text) {
  std::string out;
  for (const char c : escaped(text, "'\\''")) {
    if (c == '[' || c == ']' || c == ':') out += '\\';
    out += c;
  }
  return out;
}

std::string zshValue(const FlagRow& flag) {
  if (!flag.choices.empty()) return "(" + joined(flag.choices) + ")";
  return flag.isFile ? "_files" : "";
}

/// `place`: of an argument among the command's, from 1.
std::string zshArgument(const FlagRow& flag, int place) {
  const std::string which = flag.isRepeatable ? "*" : std::to_string(place);
  return "'" + which + ":" + zshText(flag.name) + ":" + zshValue(flag) + "'";
}

std::string zshFlag(const FlagRow& flag) {
  std::string text = "'*" + flag.name + "[" + zshText(flag.says) + "]";
  if (flag.value.empty()) return text + "'";
  return text + ":" + zshText(flag.value) + ":" + zshValue(flag) + "'";
}

} // namespace

std::string bashCompletion(std::span<const CommandRow> commands) {
  std::string names, values, flags;
  for (const CommandRow& command : commands) {
    names += (names.empty() ? "" : " ") + command.name;
    flags += "    " + command.name + ") words=\"" + flagNames(command) + "\" ;;\n";
    for (const FlagRow& flag : command.flags) {
      if (flag.choices.empty() || flag.isArgument) continue;
      values += "    \"" + command.name + " " + flag.name + "\") words=\"" + joined(flag.choices) + "\" ;;\n";
    }
    std::string choices;
    for (const FlagRow& flag : command.flags) {
      if (flag.isArgument && !flag.choices.empty()) choices = joined(flag.choices);
    }
    if (!choices.empty()) values += "    \"" + command.name + " " + command.name + "\") words=\"" + choices + "\" ;;\n";
  }
  return "# bash completion of gnomon: gnomon completion bash > /usr/share/bash-completion/completions/gnomon\n"
         "_gnomon() {\n"
         "  local current=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} words=\"\"\n"
         "  COMPREPLY=()\n"
         "  if [[ $COMP_CWORD -eq 1 ]]; then\n"
         "    mapfile -t COMPREPLY < <(compgen -W \"" +
         names +
         "\" -- \"$current\")\n"
         "    return\n"
         "  fi\n"
         "  case \"${COMP_WORDS[1]} $before\" in\n" +
         values +
         "  esac\n"
         "  if [[ -z $words && $current == -* ]]; then\n"
         "    case ${COMP_WORDS[1]} in\n" +
         flags +
         "    esac\n"
         "  fi\n"
         "  [[ -z $words ]] || mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$current\")\n"
         "}\n"
         "complete -o bashdefault -o default -F _gnomon gnomon\n";
}

std::string zshCompletion(std::span<const CommandRow> commands) {
  std::string names, cases;
  for (const CommandRow& command : commands) {
    names += "    '" + command.name + ":" + escaped(command.says, "'\\''") + "'\n";
    cases += "    " + command.name + ") _arguments";
    int place = 0;
    for (const FlagRow& flag : command.flags) {
      cases += " \\\n      " + (flag.isArgument ? zshArgument(flag, ++place) : zshFlag(flag));
    }
    cases += " ;;\n";
  }
  return "#compdef gnomon\n"
         "_gnomon() {\n"
         "  local -a commands=(\n" +
         names +
         "  )\n"
         "  if (( CURRENT == 2 )); then\n"
         "    _describe command commands\n"
         "    return\n"
         "  fi\n"
         "  shift words\n"
         "  (( CURRENT-- ))\n"
         "  case $words[1] in\n" +
         cases +
         "  esac\n"
         "}\n"
         "_gnomon \"$@\"\n";
}

std::string fishCompletion(std::span<const CommandRow> commands) {
  std::string text = "# fish completion of gnomon: gnomon completion fish > ~/.config/fish/completions/gnomon.fish\n";
  for (const CommandRow& command : commands) {
    text += "complete -c gnomon -n __fish_use_subcommand -f -a " + command.name + " -d '" +
            escaped(command.says, "\\'") + "'\n";
    for (const FlagRow& flag : command.flags) {
      const std::string condition = "complete -c gnomon -n '__fish_seen_subcommand_from " + command.name + "'";
      if (flag.isArgument && !flag.choices.empty()) text += condition + " -f -a '" + joined(flag.choices) + "'\n";
      if (flag.isArgument) continue;
      text += condition + " -l " + flag.name.substr(2);
      if (!flag.shortName.empty()) text += " -s " + flag.shortName.substr(1);
      if (!flag.value.empty()) text += flag.isFile ? " -r -F" : " -x";
      if (!flag.choices.empty()) text += " -a '" + joined(flag.choices) + "'";
      text += " -d '" + escaped(flag.says, "\\'") + "'\n";
    }
  }
  return text;
}

} // namespace gnomon::cli
