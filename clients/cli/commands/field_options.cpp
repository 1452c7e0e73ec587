#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

#include "clients/cli/commands/spec_flags.h"
#include "clients/cli/spec/spec_arguments.h"

namespace gnomon::cli {
namespace {

/// A switch, which takes a value where that follows an =. `take` gives what is wrong with the value; empty = nothing.
CLI::Option* addBareFlag(CLI::App& command, const FieldFlag& field,
                         const std::function<std::string(const std::string&)>& take) {
  return command.add_flag(std::string(field.flag) + "{" + field.bare + "}")->description(field.says)->check(take);
}

CLI::Option* addValueFlag(CLI::App& command, const FieldFlag& field, const std::string& name,
                          const std::function<std::string(const std::string&)>& take) {
  return command.add_option_function<std::string>(
      name,
      [take, &field](const std::string& text) {
        const std::string wrong = take(text);
        if (!wrong.empty()) throw CLI::ValidationError(field.flag, wrong);
      },
      field.says);
}

} // namespace

void addFieldFlags(CLI::App& command, SpecArguments& arguments, const std::vector<CLI::Option*>& placements) {
  for (const FieldFlag& field : kFieldFlags) {
    // `evaluate` has a --variant of its own: a variant of the frame.
    const bool isTaken = command.get_option_no_throw(field.flag) != nullptr;
    const auto take = [&arguments, &field](const std::string& text) -> std::string {
      const auto value = fieldValue(field, text);
      if (!value) return value.problems().front().detail;
      arguments.fields[field.flag] = text;
      return "";
    };
    auto* option = field.bare != nullptr
                       ? addBareFlag(command, field, take)
                       : addValueFlag(command, field, isTaken ? "--material-variant" : field.flag, take);
    option->type_name(field.typeName)->group("Picture");
    if (field.replaces != kOtherPlacements) continue;
    for (CLI::Option* placement : placements) option->excludes(placement);
  }
}

} // namespace gnomon::cli
