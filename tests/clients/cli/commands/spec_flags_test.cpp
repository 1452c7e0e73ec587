#include "clients/cli/commands/spec_flags.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "clients/cli/commands/commands.h"

namespace gnomon::cli {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

/// The file of the request that a command line names; what is wrong with the line where it names none or two.
std::string specOf(std::vector<std::string> words) {
  CLI::App command;
  std::string scene, spec;
  command.add_option("scene", scene)->required();
  addSpecFlag(command, spec);
  addSpecArgument(command, spec);
  std::reverse(words.begin(), words.end()); // as CLI11 takes them
  try {
    command.parse(std::move(words));
  } catch (const CLI::ParseError& error) {
    return error.what();
  }
  return spec;
}

TEST(SpecFlags, AFlagOrThePlaceBehindTheSceneNamesTheRequest) {
  EXPECT_EQ(specOf({"a.glb"}), "");
  EXPECT_EQ(specOf({"a.glb", "--spec", "r.json"}), "r.json");
  EXPECT_EQ(specOf({"--spec", "-", "a.glb"}), "-");
  EXPECT_EQ(specOf({"a.glb", "r.json"}), "r.json");
}

TEST(SpecFlags, TwoRequestsAreRefused) {
  EXPECT_EQ(specOf({"a.glb", "r.json", "--spec", "s.json"}), "--spec excludes request");
  EXPECT_EQ(specOf({"a.glb", "--spec", "s.json", "r.json"}), "--spec excludes request");
}

TEST(SpecFlags, EveryCommandThatTakesARequestTakesItByTheSameFlag) {
  CLI::App app;
  const auto kept = addClientCommands(app);
  for (const char* name : {"render", "plan", "sequence", "turntable", "bake", "evaluate"}) {
    const CLI::Option* spec = app.get_subcommand(name)->get_option_no_throw("--spec");
    ASSERT_NE(spec, nullptr) << name;
    EXPECT_EQ(spec->get_type_name(), "FILE") << name;
    EXPECT_THAT(spec->get_description(),
                StartsWith("A request as JSON; - is standard input. Flags override its fields"));
  }
  EXPECT_THAT(app.get_subcommand("sequence")->get_option("--spec")->get_description(), HasSubstr("/sequences"));
}

} // namespace
} // namespace gnomon::cli
