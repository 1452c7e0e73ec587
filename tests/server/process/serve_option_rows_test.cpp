#include "server/process/serve_option_rows.h"

#include <CLI/CLI.hpp>
#include <gtest/gtest.h>
#include <string>

#include "server/process/serve_flags.h"
#include "tests/support/page_table.h"

namespace gnomon {
namespace {

std::string sizeText(std::uint64_t bytes) {
  if (bytes == 0) return "0";
  return bytes % (1u << 30) == 0 ? std::to_string(bytes >> 30) + " GB" : std::to_string(bytes >> 20) + " MB";
}

std::string defaultOf(const CLI::Option& option, const OptionRow& row) {
  if (std::holds_alternative<bool ServeOptions::*>(row.member)) return "off";
  const std::string text = option.get_default_str();
  if (text.empty()) return "none";
  if (row.value.name == kBytes) return sizeText(std::stoull(text));
  if (row.value.name == kSeconds) return text + " s";
  return "`" + text + "`";
}

std::string optionTable() {
  CLI::App command;
  ServeOptions options;
  addServeFlags(command, options);
  std::string table = "| flag | variable | default | what it is, and what more of it costs |\n|---|---|---|---|\n";
  for (const OptionGroup& group : kOptionGroups) {
    for (const OptionRow& row : group.rows) {
      const std::string flag = "--" + std::string(row.name);
      const CLI::Option& option = *command.get_option(flag);
      table += "| `" + flag + "` | `" + option.get_envname() + "` | " + defaultOf(option, row) + " | ";
      table += std::string(row.says) + " |\n";
    }
  }
  return table;
}

TEST(Readme, TheTableOfServerOptionsIsThatOfTheRows) {
  testing::expectTable(GNOMON_OPERATIONS, "options", optionTable());
}

} // namespace
} // namespace gnomon
