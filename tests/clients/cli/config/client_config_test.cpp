#include "clients/cli/config/client_config.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace gnomon::cli {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::vector<std::string> kKeys{"server", "size", "sun"};

TEST(UsualConfigFile, IsWhereTheDesktopSays) {
  EXPECT_EQ(usualConfigFile("/x", "/home/me"), "/x/gnomon/config");
  EXPECT_EQ(usualConfigFile(nullptr, "/home/me"), "/home/me/.config/gnomon/config");
  EXPECT_EQ(usualConfigFile("", "/home/me"), "/home/me/.config/gnomon/config");
  EXPECT_EQ(usualConfigFile("relative", "/home/me"), "/home/me/.config/gnomon/config");
  EXPECT_EQ(usualConfigFile(nullptr, nullptr), "");
}

TEST(ClientConfig, HasDefaultsAndPresets) {
  const auto config = parseClientConfig("size = '2x2'\n[preset.a]\nsun = '1,2'\n[preset.b]\n", "f", kKeys);
  ASSERT_TRUE(config);
  const std::vector<std::string> presets{"b", "a"};
  const auto layers = layersOf(*config, presets);
  ASSERT_TRUE(layers);
  ASSERT_EQ(layers->size(), 3u);
  EXPECT_EQ((*layers)[0].entries.at(0).key, "size");
  EXPECT_EQ((*layers)[1].preset, "b");
  EXPECT_EQ((*layers)[2].preset, "a");
}

TEST(ClientConfig, WhatIsUnknownHasItsLineAndTheNearestName) {
  const auto config = parseClientConfig("\nsevrer = 'x'\n[preset.a]\nsize = '1x1'\nmoon = 1\n[presets]\n", "f", kKeys);
  ASSERT_FALSE(config);
  ASSERT_EQ(config.problems().size(), 3u);
  EXPECT_EQ(config.problems()[0].pointer, "f:2");
  EXPECT_THAT(config.problems()[0].detail, HasSubstr("sevrer; did you mean server?"));
  EXPECT_EQ(config.problems()[1].pointer, "f:5");
  EXPECT_EQ(config.problems()[2].pointer, "f:6");
  EXPECT_THAT(config.problems()[2].detail, HasSubstr("[preset.NAME]"));
}

TEST(ClientConfig, AnUnknownPresetIsToldWithThoseThatThereAre) {
  const auto config = parseClientConfig("[preset.preview]\n[preset.final]\n", "f", kKeys);
  ASSERT_TRUE(config);
  const std::vector<std::string> mistyped{"previw"}, none{""};
  const auto layers = layersOf(*config, mistyped);
  ASSERT_FALSE(layers);
  EXPECT_THAT(layers.problems()[0].detail, HasSubstr("did you mean preview?"));
  EXPECT_EQ(layers.problems()[0].limit, "preview, final");
  EXPECT_FALSE(layersOf(*config, none)); // the defaults are no preset
  EXPECT_FALSE(layersOf({}, mistyped));
}

TEST(ClientConfig, FilesAreNamedFromItsFolder) {
  EXPECT_EQ(fileNamedIn("/a/config", "ca.pem", "/home/me"), "/a/ca.pem");
  EXPECT_EQ(fileNamedIn("config", "ca.pem", "/home/me"), "ca.pem");
  EXPECT_EQ(fileNamedIn("/a/config", "/b/ca.pem", "/home/me"), "/b/ca.pem");
  EXPECT_EQ(fileNamedIn("/a/config", "~/ca.pem", "/home/me"), "/home/me/ca.pem");
  EXPECT_EQ(fileNamedIn("/a/config", "~/ca.pem", nullptr), "/a/~/ca.pem");
}

RC_GTEST_PROP(ClientConfig, AnyBytesAreReadOrRefused, (const std::string& bytes)) {
  const auto config = parseClientConfig(bytes, "f", kKeys);
  if (config) {
    for (const ConfigLayer& layer : config->layers) {
      for (const ConfigEntry& entry : layer.entries) {
        RC_ASSERT(std::count(kKeys.begin(), kKeys.end(), entry.key) == 1);
      }
    }
  } else {
    RC_ASSERT(!config.problems().empty());
  }
}

const std::vector<std::string> kFlagKeys{"size", "width", "set",   "server",  "ca-file",
                                         "view", "gpu",   "depth", "patience"};

/// A command with a flag of every kind.
struct Command {
  CLI::App app;
  std::string size, server, caFile, spec, request;
  int width = 0, depth = 0, patience = 0;
  std::vector<std::string> sets, views;
  bool gpu = false;

  Command() {
    app.add_option("--spec", spec);
    app.add_option("request", request);
    auto* widthOption = app.add_option("--width", width)->group("Picture");
    app.add_option("--size", size)->excludes(widthOption)->group("Picture");
    app.add_option("--set", sets)->take_all()->group("Picture");
    app.add_option("--view", views)->take_all()->group("Picture");
    auto* serverOption = app.add_option("--server", server)->envname("GNOMON_TEST_URL")->group("Server");
    app.add_option("--ca-file", caFile)->type_name("FILE")->needs(serverOption)->group("Server");
    app.add_option("--patience", patience)->check(CLI::Range(1, 9))->group("Server");
    app.add_flag("--gpu", gpu)->group("Where");
    app.add_option("--depth", depth); // no group that a configuration may set
  }
};

struct Outcome {
  std::unique_ptr<Command> command;
  Result<FlagPlaces> places;
};

/// The command after `config` and the command line.
Outcome run(const std::string& config, std::vector<std::string> typed, std::vector<std::string> presets = {}) {
  std::reverse(typed.begin(), typed.end());
  Command mirror;
  mirror.app.get_option("--server")->envname("");
  mirror.app.parse(std::vector<std::string>(typed));
  auto command = std::make_unique<Command>();
  const auto parsed = parseClientConfig(config, "/c/config", kFlagKeys);
  if (!parsed) return {std::move(command), parsed.problems()};
  const auto layers = layersOf(*parsed, presets);
  if (!layers) return {std::move(command), layers.problems()};
  auto places = setFlags(command->app, mirror.app, "/c/config", *layers);
  if (places) command->app.parse(std::move(typed));
  return {std::move(command), std::move(places)};
}

TEST(FlagLayers, TheCommandLineGoesBeforeAPresetAndThatBeforeDefaults) {
  const std::string config = "size = '1x1'\n[preset.a]\nsize = '2x2'\n[preset.b]\nsize = '3x3'\n";
  EXPECT_EQ(run(config, {}).command->size, "1x1");
  EXPECT_EQ(run(config, {}, {"a"}).command->size, "2x2");
  EXPECT_EQ(run(config, {}, {"a", "b"}).command->size, "3x3");
  EXPECT_EQ(run(config, {"--size", "4x4"}, {"a"}).command->size, "4x4");
  EXPECT_EQ(run(config, {}, {"a"}).places->at("--size"), "preset a, /c/config:3");
}

TEST(FlagLayers, OnlySetAddsUp) {
  const std::string config = "set = ['a=1']\nview = ['x', 'y']\n[preset.p]\nset = ['b=2', 'c=2']\n";
  const auto all = run(config, {"--set", "c=3", "--view", "z"}, {"p"});
  EXPECT_THAT(all.command->sets, ElementsAre("a=1", "b=2", "c=2", "c=3"));
  EXPECT_THAT(all.command->views, ElementsAre("z"));
  EXPECT_TRUE(all.places->contains("--set b"));
  EXPECT_FALSE(all.places->contains("--set c")); // the one that counts was typed
  EXPECT_THAT(run(config, {}).command->views, ElementsAre("x", "y"));
}

TEST(FlagLayers, WhatExcludesAWeakerFlagLeavesItOut) {
  EXPECT_EQ(run("size = '1x1'", {"--width", "5"}).command->size, "");
  const auto preset = run("size = '1x1'\n[preset.p]\nwidth = 7\n", {}, {"p"});
  EXPECT_EQ(preset.command->size, "");
  EXPECT_EQ(preset.command->width, 7);
  const auto both = run("size = '1x1'\nwidth = 7\n", {});
  ASSERT_FALSE(both.places);
  EXPECT_EQ(both.places.problems()[0].pointer, "/c/config:2");
}

TEST(FlagLayers, WhatNeedsAFlagThatNobodyGivesIsLeftOut) {
  EXPECT_EQ(run("ca-file = 'ca.pem'", {}).command->caFile, "");
  EXPECT_EQ(run("ca-file = 'ca.pem'", {"--server", "s"}).command->caFile, "/c/ca.pem");
  EXPECT_EQ(run("ca-file = 'ca.pem'\nserver = 's'", {}).command->caFile, "/c/ca.pem");
}

TEST(FlagLayers, AnEmptyValueHidesThatOfAWeakerLayer) {
  const std::string config = "server = 's'\ngpu = true\n[preset.here]\nserver = ''\ngpu = false\n";
  EXPECT_EQ(run(config, {}).command->server, "s");
  EXPECT_TRUE(run(config, {}).command->gpu);
  EXPECT_EQ(run(config, {}, {"here"}).command->server, "");
  EXPECT_FALSE(run(config, {}, {"here"}).command->gpu);
}

TEST(FlagLayers, ARequestMeansTheSameEverywhere) {
  const std::string config = "size = '1x1'\nserver = 's'\n[preset.p]\nset = ['b=2']\n";
  for (const auto& typed : std::vector<std::vector<std::string>>{{"--spec", "a.json"}, {"a.json"}}) {
    const auto asked = run(config, typed, {"p"});
    EXPECT_EQ(asked.command->size, "");
    EXPECT_EQ(asked.command->server, "s");
    EXPECT_THAT(asked.command->sets, ElementsAre("b=2"));
  }
}

TEST(FlagLayers, TheEnvironmentGoesBeforeDefaultsAndAfterPresets) {
  ::setenv("GNOMON_TEST_URL", "e", 1);
  const std::string config = "server = 's'\n[preset.p]\nserver = 'p'\n";
  EXPECT_EQ(run(config, {}).command->server, "e");
  EXPECT_EQ(run(config, {}, {"p"}).command->server, "p");
  ::unsetenv("GNOMON_TEST_URL");
  EXPECT_EQ(run(config, {}).command->server, "s");
}

TEST(FlagLayers, AValueThatTheFlagRefusesHasItsLine) {
  for (const auto& [config, says] : {std::pair("patience = 10", "patience: "), std::pair("gpu = 3", "true or false"),
                                     std::pair("width = 'x'", "width: "), std::pair("width = [1, 2]", "not a list")}) {
    const auto refused = run(std::string("\n") + config, {});
    ASSERT_FALSE(refused.places) << config;
    EXPECT_EQ(refused.places.problems()[0].pointer, "/c/config:2");
    EXPECT_THAT(refused.places.problems()[0].detail, HasSubstr(says));
  }
}

TEST(FlagLayers, OneRunsOwnFlagsAreNotConfigured) {
  EXPECT_EQ(run("depth = 3", {}).command->depth, 0);
}

} // namespace
} // namespace gnomon::cli
