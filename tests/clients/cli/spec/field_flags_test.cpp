#include <CLI/CLI.hpp>
#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "clients/cli/commands/commands.h"
#include "clients/cli/commands/spec_flags.h"
#include "clients/cli/spec/spec_arguments.h"

namespace gnomon::cli {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

const FieldFlag& flagOf(std::string_view name) {
  return *std::find_if(kFieldFlags.begin(), kFieldFlags.end(), [&](const auto& row) { return name == row.flag; });
}

/// The order of keys is no part of a spec.
nlohmann::json with(const char* spec, std::string_view flag, std::string_view text) {
  Json json = Json::parse(spec);
  EXPECT_TRUE(applyFieldFlag(json, flagOf(flag), text));
  return nlohmann::json::parse(json.dump());
}

TEST(FieldFlags, TakeThePlaceOfWhatExcludesThem) {
  EXPECT_EQ(with(R"({"camera": {"node": 1, "perspective": {"near": 1}}})", "--eye", "1,2,3"),
            nlohmann::json::parse(R"({"camera": {"perspective": {"near": 1}, "eye": [1.0, 2.0, 3.0]}})"));
  EXPECT_EQ(with(R"({"camera": {"target": [1, 1, 1], "orthographic": {"height": 2}}})", "--fov", "40"),
            nlohmann::json::parse(R"({"camera": {"target": [1, 1, 1], "perspective": {"fovYDegrees": 40.0}}})"));
}

TEST(FieldFlags, AnAnimationIsANameOrAnIndex) {
  EXPECT_EQ(with(R"({"animation": {"name": "x", "timeSeconds": 2}})", "--animation", "3"),
            nlohmann::json::parse(R"({"animation": {"index": 3, "timeSeconds": 2}})"));
  EXPECT_EQ(with(R"({"animation": {"index": 3}})", "--animation", "Walk 2"),
            nlohmann::json::parse(R"({"animation": {"name": "Walk 2"}})"));
}

TEST(FieldFlags, ABackgroundHasAnAlphaIfAFourthNumberIsGiven) {
  EXPECT_EQ(with(R"({"background": {"alpha": 0.5}})", "--background", "0.1,0.2,0.3"),
            nlohmann::json::parse(R"({"background": {"alpha": 0.5, "color": [0.1, 0.2, 0.3]}})"));
  EXPECT_EQ(with("{}", "--background", "0,0,0,0"),
            nlohmann::json::parse(R"({"background": {"alpha": 0.0, "color": [0.0, 0.0, 0.0]}})"));
  for (const char* text : {"0,0", "0,0,0,0,0", "white"}) {
    const auto refused = fieldValue(flagOf("--background"), text);
    ASSERT_FALSE(refused) << text;
    EXPECT_NE(refused.problems().front().detail.find("or four with alpha"), std::string::npos);
  }
}

TEST(FieldFlags, BadTextsAndPlacesAreProblems) {
  for (const char* text : {"", "1", "1,2", "1,2,3,4", "1,2,x", "1,2,nan"}) {
    EXPECT_FALSE(fieldValue(flagOf("--eye"), text)) << text;
  }
  EXPECT_FALSE(fieldValue(flagOf("--fov"), "wide"));
}

/// The fields that a command line gives, by their flags; what is wrong where it is refused.
std::map<std::string, std::string> fieldsOf(std::vector<std::string> words) {
  CLI::App command;
  SpecArguments arguments;
  std::string scene;
  command.add_option("scene", scene)->required();
  addPictureFlags(command, arguments);
  std::reverse(words.begin(), words.end()); // as CLI11 takes them
  try {
    command.parse(std::move(words));
  } catch (const CLI::ParseError& error) {
    return {{"wrong", error.what()}};
  }
  arguments.fields["scene"] = scene;
  return arguments.fields;
}

TEST(FieldFlags, ASwitchTakesAValueBehindAnEqualsSignAlone) {
  using Fields = std::map<std::string, std::string>;
  EXPECT_EQ(fieldsOf({"--ground", "a.glb"}), (Fields{{"scene", "a.glb"}, {"--ground", "catcher"}}));
  EXPECT_EQ(fieldsOf({"--ground=surface", "--sky-shadows", "a.glb", "--transparent"}),
            (Fields{{"scene", "a.glb"}, {"--ground", "surface"}, {"--sky-shadows", "rays"}, {"--transparent", "0"}}));
  EXPECT_THAT(fieldsOf({"a.glb", "--transparent=half"})["wrong"], HasSubstr("a number"));
  EXPECT_EQ(with("{}", "--ground", "catcher"), nlohmann::json::parse(R"({"ground": {"mode": "catcher"}})"));
  EXPECT_EQ(with(R"({"background": {"color": [1, 0, 0]}})", "--transparent", "0"),
            nlohmann::json::parse(R"({"background": {"color": [1, 0, 0], "alpha": 0.0}})"));
}

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
