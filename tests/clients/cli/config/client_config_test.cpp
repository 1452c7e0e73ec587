#include "clients/cli/config/client_config.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace gnomon::cli {
namespace {

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

} // namespace
} // namespace gnomon::cli
